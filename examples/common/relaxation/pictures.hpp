// SPDX-License-Identifier: MIT
/// @file  The pictures of a study: what the maps look like, where the photons lie, spectra, plots.
#pragma once

#include "common/relaxation/study.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace nephroid::examples::relaxation {

/// Writes before-K.png and after-K.png for each number of neighbours K, before-best.png and truth.png where the truth
/// is known, dots-before.png, dots-after.png and features.png of photons on a floor, and spectrum-before.png and
/// spectrum-after.png where there is evenly lit floor.
/// @return  notes on what could not be shown
std::vector<std::string> write_pictures(const std::filesystem::path& folder, const Subject& subject,
                                        const Study& study);

/// Writes spectrum.dat and edges.dat, as far as there is something to write, and plots them with gnuplot.
/// @return  notes on what could not be plotted
std::vector<std::string> write_plots(const std::filesystem::path& folder, const Subject& subject, const Study& study);

} // namespace nephroid::examples::relaxation
