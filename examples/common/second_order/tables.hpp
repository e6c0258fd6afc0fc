// SPDX-License-Identifier: MIT
/// @file  What the program `second_order` found, as Markdown and as CSV.
#pragma once

#include "common/compare/tables.hpp"
#include "common/second_order/study.hpp"

#include <iosfwd>

namespace nephroid::examples::second_order {

/// Second order's errors over first order's at the best s with as many photons; the means and the worst at the end.
[[nodiscard]] Table equal_photons_table(const std::vector<Study>& studies);

/// The same over what first order comes to in the time that second order takes, at the best s for the number of photons
/// that this time is enough for.
[[nodiscard]] Table equal_seconds_table(const std::vector<Study>& studies);

/// The powers of the number of photons that errors fall with.
[[nodiscard]] Table slopes_table(const std::vector<Study>& studies, double fixed_smoothing);

/// As Markdown.
void print_markdown(std::ostream& out, const Table& table);

/// All figures, a row for each case, sequence, number of photons and way of splatting.
[[nodiscard]] std::string csv_text(const std::vector<Study>& studies);

} // namespace nephroid::examples::second_order
