// SPDX-License-Identifier: MIT
/// @file  The table of ratios that `benchmark` prints.
#pragma once

#include "common/table.hpp"
#include "common/text.hpp"

#include <cmath>
#include <cstddef>
#include <iostream>
#include <string>
#include <vector>

namespace nephroid::examples::benchmarks {

/// The bound that a ratio should meet.
struct Bar {
    enum class Kind { none, at_least, at_most } kind = Kind::none;
    double value = 0;

    [[nodiscard]] static Bar at_least(double value) { return {Kind::at_least, value}; }
    [[nodiscard]] static Bar at_most(double value) { return {Kind::at_most, value}; }

    [[nodiscard]] std::string text() const {
        if (kind == Kind::none)
            return "";
        return examples::text(kind == Kind::at_least ? ">= %.4g" : "<= %.4g", value);
    }
    /// "met", "missed", or an empty text if there is no bound.
    [[nodiscard]] const char* verdict(double ratio) const {
        if (kind == Kind::none)
            return "";
        return (kind == Kind::at_least ? ratio >= value : ratio <= value) ? "met" : "missed";
    }
};

/// Prints a row at once: measuring the next one takes a while.
inline void print_cells(const TableRow& cells) {
    static const std::vector<std::size_t> widths = {58, 12, 30, 8, 8, 6};
    std::cout << markdown_row(cells, widths) << std::flush;
}

inline void print_heading() {
    print_cells({"what", "measured", "yardstick", "ratio", "bar", ""});
    print_cells({"---", "---:", "---", "---:", "---", "---"});
}

/// Prints one row: a measured figure with its unit, and its ratio to a yardstick. A ratio that is NaN is left blank.
inline void print_row(const std::string& what, double figure, const char* unit, const char* yardstick, double ratio,
                      Bar bar = {}) {
    print_cells({what, text("%.4g %s", figure, unit), yardstick, std::isfinite(ratio) ? text("%.3g", ratio) : "",
                 bar.text(), bar.verdict(ratio)});
}

} // namespace nephroid::examples::benchmarks
