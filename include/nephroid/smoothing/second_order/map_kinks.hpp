// SPDX-License-Identifier: MIT
/// @file  Measures the kinks of a map: lines at which its derivatives jump, as at the edges of a mesh with interpolated
///        normals.
#pragma once

#include "nephroid/smoothing/second_order/tangent_jumps.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace nephroid::detail {

/// How often and how far derivatives jump between photons next to each other. Those of several cells can be added up.
struct MapKinks {
    double photons = 0;
    double jumps = 0; ///< sum over the photons of |J⁻¹ΔJ|²/|δ|

    void add(const MapKinks& other, double weight) {
        photons += weight * other.photons;
        jumps += weight * other.jumps;
    }
    /// The jumps that a line of unit length crosses, squared and summed, per u0.
    [[nodiscard]] double density() const { return photons > 0 ? jumps / photons : 0; }
};

/// The kinks among some photons, from their `tangent_jumps`. A line through them of length |δ| crosses a kink with
/// a chance in proportion to |δ|, however large the kink is, so that |J⁻¹ΔJ|²/|δ| has the same mean for any
/// distance δ of the nearest photon. In a smooth map it is almost 0. Only photons of one cell are compared: beside its
/// border the nearest one may be in the next cell, so that in a cell of nine up to a third of the pairs, and of the
/// kinks, are missed.
///
/// Jumps of more than a third of the tangents count the less the larger they are. Where a map is singular (the rim of a
/// ball) all photons differ by as much, and smaller footprints would only show single photons.
[[nodiscard]] inline MapKinks map_kinks(const std::vector<TangentJump>& jumps) {
    constexpr double large = 0.1;   // squared: a jump that counts for half
    constexpr double nearest = 0.1; // u0: random photons that happen to be closer are taken to be this far apart
    MapKinks kinks{.photons = double(jumps.size())};
    for (const TangentJump& jump : jumps)
        if (std::isfinite(jump.size2))
            kinks.jumps +=
                jump.size2 / (1 + square(jump.size2 / large)) / (std::max)(std::sqrt(jump.distance2), nearest);
    return kinks;
}

} // namespace nephroid::detail
