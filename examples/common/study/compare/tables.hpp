// SPDX-License-Identifier: MIT
/// @file  What a comparison found, as tables.
#pragma once

#include "common/study/trial.hpp"
#include "common/table.hpp"

namespace nephroid::examples::study::compare {

/// Photons and seconds that each method needs to match photon differential splatting at the target count, by rel, RMSE
/// and SSIM: a table for each pair of sequences, splatting's never the later one. None without the method `splat`.
[[nodiscard]] std::vector<Table> equal_error_tables(const Options& options, const std::vector<Trial>& trials);

/// What each method reaches in the time that photon differential splatting takes at each count.
[[nodiscard]] std::vector<Table> equal_time_tables(const Options& options, const std::vector<Trial>& trials);

/// The powers of the number of photons that errors fall with.
[[nodiscard]] Table slope_table(const Options& options, const std::vector<Trial>& trials);

/// The best of each trial, measure by measure.
[[nodiscard]] Table best_table(const std::vector<Trial>& trials, Measure measure);

/// The names of all of them: "equal-error", …
[[nodiscard]] std::vector<std::string> table_names();

} // namespace nephroid::examples::study::compare
