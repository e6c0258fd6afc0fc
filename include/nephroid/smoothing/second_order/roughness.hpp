// SPDX-License-Identifier: MIT
/// @file  By how much a map bends that no smooth one fits: facets of a mesh, ripples smaller than a cell of photons.
#pragma once

#include "nephroid/smoothing/second_order/bending.hpp"

#include <limits>
#include <span>

namespace nephroid::detail {

/// A photon's J, and what of it a map does not explain.
struct TangentResidual {
    std::array<double, 4> at; ///< emission coordinates, in u0; those that a light does not have are 0
    std::array<Space3, 2> tangents, unexplained;
};

/// The mean over the photons of |J⁻¹ΔJ|²/|δ|², per u0²: by what the nearest photon's J differs that the map
/// does not explain, over how far away it is. Of a smooth map next to nothing.
///
/// A pair counts for 0.15 at most: where a map is singular (the rim of a ball) all photons differ, and small footprints
/// would only show them.
///
/// @return  0 for fewer than two photons
[[nodiscard]] inline double roughness(std::span<const TangentResidual> photons) {
    if (photons.size() < 2)
        return 0;
    constexpr double most = 0.15;
    const auto distance2_between = [](const TangentResidual& a, const TangentResidual& b) {
        double sum = 0;
        for (std::size_t axis = 0; axis < 4; ++axis)
            sum += square(b.at[axis] - a.at[axis]);
        return sum;
    };
    const auto size2 = [](const std::array<Space3, 2>& tangents, const std::array<Space3, 2>& jump) {
        const EmissionPullback pull_back(tangents);
        const Plane2 u = pull_back(jump[0]), v = pull_back(jump[1]);
        return inner(u, u) + inner(v, v);
    };
    double sum = 0;
    for (const TangentResidual& a : photons) {
        const TangentResidual* nearest = nullptr;
        double distance2 = std::numeric_limits<double>::infinity();
        for (const TangentResidual& b : photons)
            if (const double d2 = distance2_between(a, b); &b != &a && d2 < distance2) {
                distance2 = d2;
                nearest = &b;
            }
        if (nearest == nullptr || !(distance2 > 0))
            continue;
        const std::array<Space3, 2> jump{nearest->unexplained[0] - a.unexplained[0],
                                         nearest->unexplained[1] - a.unexplained[1]};
        // By the wider of the two: what is folded flat would make any jump a large one.
        sum += (std::min)(most, (std::min)(size2(a.tangents, jump), size2(nearest->tangents, jump)) / distance2);
    }
    return sum / double(photons.size());
}

} // namespace nephroid::detail
