// SPDX-License-Identifier: MIT
/// @file  The report: one HTML page with plots, pictures and tables in it, that needs no other file and no script.
#pragma once

#include "common/compare/pictures.hpp"
#include "common/compare/plots.hpp"
#include "common/compare/tables.hpp"

namespace nephroid::examples {

/// What the report shows beside the tables that it makes of the trials.
struct Exhibition {
    std::vector<Plot> plots; ///< none without gnuplot
    std::vector<Strip> strips;
    std::filesystem::path pictures; ///< the folder of `write_pictures`, with reference.png
    double seconds = 0;             ///< that the comparison took
};

/// The page. Reads the files of the exhibition, and the processor's name from the system.
[[nodiscard]] std::string html_page(const CompareOptions& options, const Bench& bench, const std::vector<Trial>& trials,
                                    const Exhibition& exhibition);

} // namespace nephroid::examples
