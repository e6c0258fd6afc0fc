// SPDX-License-Identifier: MIT
/// @file  Measures the bending of a map that no smooth fit explains: facets of a mesh, ripples smaller than a cell.
#pragma once

#include "nephroid/smoothing/second_order/tangent_jumps.hpp"

#include <algorithm>
#include <vector>

namespace nephroid::detail {

/// The mean over the photons of |J⁻¹ΔJ|²/|δ|², per u0². ΔJ is the difference between the residuals of a photon
/// and of its nearest neighbour, and δ the distance between the two. It is almost 0 for a smooth map.
///
/// Each pair counts for at most 0.15. Where a map is singular (the rim of a ball) all photons differ, and smaller
/// footprints would only show single photons.
///
/// @return  0 for fewer than two photons
[[nodiscard]] inline double roughness(const std::vector<TangentJump>& jumps) {
    constexpr double limit = 0.15;
    double sum = 0;
    for (const TangentJump& jump : jumps)
        sum += (std::min)(limit, jump.size2 / jump.distance2);
    return jumps.empty() ? 0 : sum / double(jumps.size());
}

} // namespace nephroid::detail
