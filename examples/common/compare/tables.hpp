// SPDX-License-Identifier: MIT
/// @file  The figures as tables for people.
#pragma once

#include "common/compare/comparison.hpp"

#include <iosfwd>

namespace nephroid::examples {

/// Cells of text, row by row.
struct Table {
    std::string title, caption;
    std::vector<std::string> header;
    std::vector<std::vector<std::string>> rows;
};

/// "0.0254", with as many digits as tell.
[[nodiscard]] std::string figure(double value);

/// Photons and seconds that each method needs to match photon differential splatting at the target count, by rel, RMSE
/// and SSIM: a table for each pair of sequences, splatting's never the later one. None without the method `splat`.
[[nodiscard]] std::vector<Table> equal_error_tables(const CompareOptions& options, const std::vector<Trial>& trials);

/// What each method reaches in the time that photon differential splatting takes at each count.
[[nodiscard]] std::vector<Table> equal_time_tables(const CompareOptions& options, const std::vector<Trial>& trials);

/// The powers of the number of photons that errors fall with.
[[nodiscard]] Table slope_table(const CompareOptions& options, const std::vector<Trial>& trials);

/// The best of each trial, measure by measure.
[[nodiscard]] Table best_table(const std::vector<Trial>& trials, Measure measure);

/// For a terminal.
void print(std::ostream& out, const Table& table);

/// One line for each trial as it is finished.
[[nodiscard]] std::string summary(const Trial& trial);

} // namespace nephroid::examples
