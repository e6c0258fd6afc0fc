// SPDX-License-Identifier: MIT
/// @file  Measures the bending of a map that no smooth fit explains: facets of a mesh, ripples smaller than a cell.
#pragma once

#include "nephroid/smoothing/second_order/bending.hpp"

#include <limits>
#include <vector>

namespace nephroid::detail {

/// A photon's J, and its difference from the fitted map's.
struct TangentResidual {
    std::array<double, 4> at; ///< emission coordinates, in u0; 0 for those that a light does not have
    std::array<Double3, 2> tangents, residual;
};

/// The mean over the photons of |J⁻¹ΔJ|²/|δ|², per u0². ΔJ is the difference between the residuals of a photon
/// and of its nearest neighbour, and δ the distance between the two. It is almost 0 for a smooth map.
///
/// Each pair counts for at most 0.15. Where a map is singular (the rim of a ball) all photons differ, and smaller
/// footprints would only show single photons.
///
/// @return  0 for fewer than two photons
[[nodiscard]] inline double roughness(const std::vector<TangentResidual>& photons) {
    if (photons.size() < 2)
        return 0;
    constexpr double limit = 0.15;
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
        const std::array<Double3, 2> jump{nearest->residual[0] - a.residual[0], nearest->residual[1] - a.residual[1]};
        // The smaller of the two values counts: relative to a collapsed footprint, any jump is large.
        sum += (std::min)(limit, (std::min)(size2(a.tangents, jump), size2(nearest->tangents, jump)) / distance2);
    }
    return sum / double(photons.size());
}

} // namespace nephroid::detail
