// SPDX-License-Identifier: MIT
/// @file  What the program `second_order` is asked to do.
#pragma once

#include "common/compare/options.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace nephroid::examples::second_order {

struct Options {
    std::vector<std::string> cases; ///< never empty
    CompareOptions each;            ///< of every case; its `scene` is filled in case by case
    double fixed_smoothing;         ///< s of the splats that are neither swept nor chosen
    std::optional<std::filesystem::path> csv;
};

/// Reads the command line.
/// @return  nothing if it asked for help, which has then been printed
/// Throws UsageError.
[[nodiscard]] std::optional<Options> read_options(int argc, const char* const* argv);

} // namespace nephroid::examples::second_order
