// SPDX-License-Identifier: MIT
/// @file  Plots by gnuplot: error against time, photons and bandwidth.
#pragma once

#include "common/compare/comparison.hpp"

namespace nephroid::examples {

struct Plot {
    std::string title;
    std::filesystem::path svg;
};

/// Whether there is a gnuplot to call.
[[nodiscard]] bool has_gnuplot();

/// Writes `folder`/plots.gp with all data in it, and lets gnuplot draw the .svg files beside it, for each sequence and
/// measure: error against time (the headline), against photons with fitted slopes if there are several counts, against
/// bandwidth for the smallest count. Lines are named by the methods' ids. The ink is `currentColor`, so that a page
/// chooses it.
/// Throws std::runtime_error if gnuplot fails.
[[nodiscard]] std::vector<Plot> draw_plots(const std::filesystem::path& folder, const CompareOptions& options,
                                           const std::vector<Trial>& trials);

} // namespace nephroid::examples
