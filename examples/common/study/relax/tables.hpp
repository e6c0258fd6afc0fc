// SPDX-License-Identifier: MIT
/// @file  What relaxing did to photon maps, as tables and as CSV.
#pragma once

#include "common/study/relax/before_and_after.hpp"
#include "common/table.hpp"

#include <string>
#include <vector>

namespace nephroid::examples::study::relax {

/// Errors, seconds and the widths of edges, for each map and number of neighbours.
[[nodiscard]] Table errors_table(const Options& options, const Subject& subject, const BeforeAndAfter& measured);

/// How blue the photons' noise is, before and after; no rows where there is no evenly lit floor.
[[nodiscard]] Table spectrum_table(const BeforeAndAfter& measured);

/// The relaxed map with 20 neighbours, the paper's number, or the nearest to it, against the unrelaxed map's best.
/// Nothing where the truth is not known.
[[nodiscard]] std::optional<TableRow> verdict_row(const Options& options, const BeforeAndAfter& measured);

/// @param rows  of `verdict_row`
[[nodiscard]] Table verdict_table(std::vector<TableRow> rows);

/// The names of all of them: "errors", …
[[nodiscard]] std::vector<std::string> table_names();

/// A line for each map and number of neighbours; what is not known is empty.
[[nodiscard]] std::string csv_text(const Subject& subject, const BeforeAndAfter& measured);

} // namespace nephroid::examples::study::relax
