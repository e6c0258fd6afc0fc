// SPDX-License-Identifier: MIT
/// @file  The table of ratios that `benchmark` prints.
#pragma once

#include <array>
#include <cmath>
#include <cstdio>
#include <string>

namespace nephroid::examples::benchmarks {

/// What a ratio is held against.
struct Bar {
    enum class Kind { none, at_least, at_most } kind = Kind::none;
    double value = 0;

    [[nodiscard]] static Bar at_least(double value) { return {Kind::at_least, value}; }
    [[nodiscard]] static Bar at_most(double value) { return {Kind::at_most, value}; }

    [[nodiscard]] std::string text() const {
        std::array<char, 32> text{};
        std::snprintf(text.data(), text.size(), kind == Kind::at_least ? ">= %.4g" : "<= %.4g", value);
        return kind == Kind::none ? "" : text.data();
    }
    /// "met", "missed", or nothing where there is no bar.
    [[nodiscard]] const char* verdict(double ratio) const {
        if (kind == Kind::none)
            return "";
        return (kind == Kind::at_least ? ratio >= value : ratio <= value) ? "met" : "missed";
    }
};

inline void print_heading() {
    std::printf("| %-58s | %12s | %-30s | %8s | %8s | %-6s |\n", "what", "measured", "yardstick", "ratio", "bar", "");
    std::printf("| --- | ---: | --- | ---: | --- | --- |\n");
}

/// One row: what was measured, as a figure with its unit, and as a ratio to its yardstick. A ratio that is not a number
/// is left blank.
inline void print_row(const std::string& what, double figure, const char* unit, const char* yardstick, double ratio,
                      Bar bar = {}) {
    std::array<char, 32> measured{}, times{};
    std::snprintf(measured.data(), measured.size(), "%.4g %s", figure, unit);
    if (std::isfinite(ratio))
        std::snprintf(times.data(), times.size(), "%.3g", ratio);
    std::printf("| %-58s | %12s | %-30s | %8s | %8s | %-6s |\n", what.c_str(), measured.data(), yardstick, times.data(),
                bar.text().c_str(), bar.verdict(ratio));
    std::fflush(stdout);
}

} // namespace nephroid::examples::benchmarks
