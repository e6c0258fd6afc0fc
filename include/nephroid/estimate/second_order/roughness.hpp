// SPDX-License-Identifier: MIT
/// @file  By how much a map bends that no smooth one fits: facets of a mesh, ripples smaller than a cell of photons.
#pragma once

#include "nephroid/estimate/second_order/smoothing_rule.hpp"

#include <limits>
#include <span>

namespace nephroid {

/// J of a photon at a displacement from where a map's derivatives are, in their axes.
struct TangentSample {
    Plane2 at;
    std::array<Space3, 2> tangents;
};

/// The mean over the photons of |J⁻¹ΔJ|²/|δ|², per u0²: by what the nearest photon's J differs that the map does not
/// explain, over how far away it is. Of a smooth map next to nothing.
///
/// A pair counts for 0.15 at most: where a map is singular (the rim of a ball) all photons differ, and small footprints
/// would only show them.
///
/// @return  0 for fewer than two photons
[[nodiscard]] inline double roughness(const PathDerivatives& map, std::span<const TangentSample> photons) {
    if (photons.size() < 2)
        return 0;
    constexpr double most = 0.15;
    const auto unexplained = [&](const TangentSample& photon) {
        const auto fitted = tangents_at(map, photon.at);
        return std::array<Space3, 2>{photon.tangents[0] - fitted[0], photon.tangents[1] - fitted[1]};
    };
    const auto size2 = [](const std::array<Space3, 2>& tangents, const std::array<Space3, 2>& jump) {
        const detail::EmissionPullback pull_back(tangents);
        const Plane2 u = pull_back(jump[0]), v = pull_back(jump[1]);
        return inner(u, u) + inner(v, v);
    };
    double sum = 0;
    for (const TangentSample& a : photons) {
        const TangentSample* nearest = nullptr;
        double distance2 = std::numeric_limits<double>::infinity();
        for (const TangentSample& b : photons) {
            const Plane2 step = b.at + -1.0 * a.at;
            if (&b != &a && inner(step, step) < distance2) {
                distance2 = inner(step, step);
                nearest = &b;
            }
        }
        if (nearest == nullptr || !(distance2 > 0))
            continue;
        const auto here = unexplained(a), there = unexplained(*nearest);
        const std::array<Space3, 2> jump{there[0] - here[0], there[1] - here[1]};
        // By the wider of the two: what is folded flat would make any jump a large one.
        sum += (std::min)(most, (std::min)(size2(a.tangents, jump), size2(nearest->tangents, jump)) / distance2);
    }
    return sum / double(photons.size());
}

} // namespace nephroid
