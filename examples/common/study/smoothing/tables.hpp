// SPDX-License-Identifier: MIT
/// @file  What a study of smoothing found, as tables and plots.
#pragma once

#include "common/study/plot.hpp"
#include "common/study/smoothing/cases.hpp"
#include "common/table.hpp"

namespace nephroid::examples::study::smoothing {

/// Second order's errors over first order's at the best s with as many photons; the means and the worst at the end.
[[nodiscard]] Table equal_photons_table(const std::vector<Case>& cases);

/// The same over what first order comes to in the time that second order takes, at the best s for the number of photons
/// that this time is enough for.
[[nodiscard]] Table equal_seconds_table(const std::vector<Case>& cases);

/// The powers of the number of photons that errors fall with.
[[nodiscard]] Table slopes_table(const std::vector<Case>& cases, double fixed_smoothing);

/// What second order comes to, and first order at its best s, a row for each number of photons.
[[nodiscard]] Table errors_table(const std::vector<Case>& cases);

/// The names of all of them: "equal-photons", …
[[nodiscard]] std::vector<std::string> table_names();

/// Error against the number of photons, for each case, sequence and measure.
[[nodiscard]] std::vector<Drawing> drawings(const std::vector<Case>& cases);

} // namespace nephroid::examples::study::smoothing
