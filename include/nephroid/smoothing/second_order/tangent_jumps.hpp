// SPDX-License-Identifier: MIT
/// @file  How far the tangents of photons next to each other are apart, beyond what the fitted map says.
#pragma once

#include "nephroid/smoothing/second_order/bending.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace nephroid::detail {

/// A photon's J, and its difference from the fitted map's.
struct TangentResidual {
    std::array<double, 4> at; ///< emission coordinates, in u0; 0 for those that a light does not have
    std::array<Double3, 2> tangents, residual;
};

/// From a photon to the one nearest to it.
struct TangentJump {
    double size2 = 0; ///< |J⁻¹ΔJ|², ΔJ the difference between the residuals of the two
    double distance2 = std::numeric_limits<double>::infinity(); ///< between their emission coordinates, in u0²; > 0
};

/// One jump for each photon: from it to its nearest neighbour. A photon that is alone, or that coincides with its
/// neighbour, gets a jump of 0 at an infinite distance.
[[nodiscard]] inline std::vector<TangentJump> tangent_jumps(const std::vector<TangentResidual>& photons) {
    const auto distance2_between = [](const TangentResidual& a, const TangentResidual& b) {
        double sum = 0;
        for (std::size_t axis = 0; axis < 4; ++axis)
            sum += square(b.at[axis] - a.at[axis]);
        return sum;
    };
    const auto size2 = [](const std::array<Double3, 2>& tangents, const std::array<Double3, 2>& jump) {
        const EmissionPullback pull_back(tangents);
        const Plane2 u = pull_back(jump[0]), v = pull_back(jump[1]);
        return inner(u, u) + inner(v, v);
    };
    std::vector<TangentJump> jumps(photons.size());
    for (std::size_t i = 0; i < photons.size(); ++i) {
        const TangentResidual& a = photons[i];
        const TangentResidual* nearest = nullptr;
        double distance2 = std::numeric_limits<double>::infinity();
        for (const TangentResidual& b : photons)
            if (const double d2 = distance2_between(a, b); &b != &a && d2 < distance2) {
                distance2 = d2;
                nearest = &b;
            }
        if (nearest == nullptr || !(distance2 > 0))
            continue;
        const std::array<Double3, 2> jump{nearest->residual[0] - a.residual[0], nearest->residual[1] - a.residual[1]};
        // The smaller of the two values counts: relative to a collapsed footprint, any jump is large.
        jumps[i] = {(std::min)(size2(a.tangents, jump), size2(nearest->tangents, jump)), distance2};
    }
    return jumps;
}

} // namespace nephroid::detail
