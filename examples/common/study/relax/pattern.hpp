// SPDX-License-Identifier: MIT
/// @file  Test patterns: densities on the unit square that photons are drawn from, and that their map is held against.
#pragma once

#include "common/study/relax/edge.hpp"

#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace nephroid::examples::study::relax {

struct Pattern {
    std::function<double(double x, double y)> density; ///< 0 to 1, anywhere in the plane
    double mean;                                       ///< of the unit square
    std::vector<Edge> edges;                           ///< whose sides are irradiances, 1 on average
    /// Where the floor itself ends: the nearest place on it. None where it goes on beyond the unit square.
    std::function<std::array<double, 2>(double x, double y)> onto_floor = nullptr;
};

/// "uniform, ellipse-and-bars, soft-disc, sines, l-shape"
[[nodiscard]] std::string pattern_names();

[[nodiscard]] bool is_pattern(const std::string& name);

/// uniform: density 1. ellipse-and-bars: an ellipse and two upright bars at ten times the density of what is around.
/// soft-disc: a disc whose brim falls off over a tenth of the square. sines: waves along both axes. l-shape: even light
/// on a floor that ends, the square without its upper right quarter: it has corners of both kinds.
/// Source of the second: Schjøth, Olsen and Sporring 2006; Spencer and Jones 2009, Figure 10.
[[nodiscard]] Pattern pattern(const std::string& name);

/// A picture's brightness as density: linear, the brightest pixel 1; beyond the picture the nearest pixel.
/// The unit square holds all of it, so a picture that is not square is stretched.
/// Throws std::runtime_error, one line, for a file that cannot be read and for a black picture.
[[nodiscard]] Pattern guide_pattern(const std::filesystem::path& png);

} // namespace nephroid::examples::study::relax
