// SPDX-License-Identifier: MIT
/// @file  Reads a program's options: numbers, names and sizes. One line that names the option says what is wrong.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>

namespace CLI {
class App;
}

namespace nephroid::examples {

/// A wrong command line; `what()` is one line.
struct UsageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The names of an option's values.
template <class Kind>
using Names = std::map<std::string, Kind>;

/// The kind with the name `text`. Throws UsageError, with all valid names, if there is none.
template <class Kind>
[[nodiscard]] Kind chosen(const std::string& option, const std::string& text, const Names<Kind>& names) {
    const auto found = names.find(text);
    if (found != names.end())
        return found->second;
    std::string known;
    for (const auto& [name, kind] : names)
        known += (known.empty() ? "" : ", ") + name;
    throw UsageError(option + ": '" + text + "' is none of " + known);
}

/// The name of a kind; "?" for one without.
template <class Kind>
[[nodiscard]] const char* name_in(const Names<Kind>& names, Kind kind) {
    for (const auto& [name, named] : names)
        if (named == kind)
            return name.c_str();
    return "?";
}

/// A whole number from `least` to 1e15, also written as 1e6. Throws UsageError.
[[nodiscard]] std::uint64_t whole_number(const std::string& option, const std::string& text, double least);

/// Pixels of a picture.
struct PictureSize {
    std::size_t width, height;
    bool height_given; ///< otherwise the height is the width
};

/// "640x360" or "512". Throws UsageError for less than 1 and more than 32768 pixels a side.
[[nodiscard]] PictureSize picture_size(const std::string& text);

/// Throws UsageError unless x_min < x_max and y_min < y_max, all finite.
void check_view(const std::array<double, 4>& view);

/// Throws UsageError for an absurd number of threads.
void check_threads(unsigned threads);

/// Parses the command line.
/// @return  false if it asked for help, which has then been printed
/// Throws UsageError.
[[nodiscard]] bool parse(CLI::App& app, int argc, const char* const* argv);

} // namespace nephroid::examples
