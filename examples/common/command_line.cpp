// SPDX-License-Identifier: MIT
#include "common/command_line.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <utility>
#include <vector>

namespace nephroid::examples {

std::uint64_t whole_number(const std::string& option, const std::string& text, double least) {
    std::size_t used = 0;
    double value = 0;
    try {
        value = std::stod(text, &used);
    } catch (const std::exception&) {
        used = std::string::npos;
    }
    if (used != text.size() || !(value >= least) || !(value <= 1e15) || value != std::floor(value))
        throw UsageError(option + ": '" + text + "' is not a whole number from " +
                         std::to_string(static_cast<std::uint64_t>(least)) + " to 1e15");
    return static_cast<std::uint64_t>(value);
}

PictureSize picture_size(const std::string& text) {
    const auto cross = text.find('x');
    const auto pixels = [](const std::string& number) {
        const std::uint64_t count = whole_number("--size", number, 1);
        if (count > 32768)
            throw UsageError("--size: " + number + " pixels are more than 32768");
        return static_cast<std::size_t>(count);
    };
    const std::size_t width = pixels(text.substr(0, cross));
    if (cross == std::string::npos)
        return {width, width, false};
    return {width, pixels(text.substr(cross + 1)), true};
}

void check_view(const std::array<double, 4>& view) {
    const auto& [x_min, x_max, y_min, y_max] = view;
    for (const double bound : view)
        if (!std::isfinite(bound))
            throw UsageError("--view: every bound must be finite");
    if (!(x_min < x_max) || !(y_min < y_max))
        throw UsageError("--view: x_min must be below x_max, and y_min below y_max");
}

void check_threads(unsigned threads) {
    if (threads > 1024)
        throw UsageError("--threads: " + std::to_string(threads) + " is more than 1024");
}

bool parse(CLI::App& app, int argc, const char* const* argv) {
    // CLI11 takes -.5 for an option of that name.
    std::vector<std::string> arguments(argv + 1, argv + argc);
    for (std::string& argument : arguments)
        if (argument.starts_with("-."))
            argument.insert(1, 1, '0');
    std::ranges::reverse(arguments); // as it wants them
    try {
        app.parse(std::move(arguments));
    } catch (const CLI::CallForHelp&) {
        std::cout << app.help();
        return false;
    } catch (const CLI::CallForVersion& version) {
        std::cout << version.what() << '\n';
        return false;
    } catch (const CLI::ParseError& error) {
        std::string line = error.what();
        std::ranges::replace(line, '\n', ' ');
        throw UsageError(line + " (--help lists the options)");
    }
    return true;
}

} // namespace nephroid::examples
