// SPDX-License-Identifier: MIT
/// @file  Measures how much of the tangents a fitted map does not explain, and bounds footprints where that is much.
#pragma once

#include "nephroid/pass/photon_pass.hpp"
#include "nephroid/smoothing/second_order/tangent_jumps.hpp"
#include "nephroid/vector/plane.hpp"
#include "nephroid/vector/scalar.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace nephroid::detail {

/// The squares of the residuals over those of the tangents, summed over the photons: 0 where the map explains the
/// tangents, and about 1 where they have nothing in common.
///
/// @return  0 for no photons; not finite if a tangent is not
[[nodiscard]] inline double tangent_scatter(const std::vector<TangentResidual>& photons) {
    double residuals = 0, tangents = 0;
    for (const TangentResidual& photon : photons)
        for (std::size_t i = 0; i < 2; ++i) {
            residuals += inner(photon.residual[i], photon.residual[i]);
            tangents += inner(photon.tangents[i], photon.tangents[i]);
        }
    return residuals > 0 ? residuals / tangents : 0;
}

/// S with no more area than tangents allow that scatter.
///
/// Between photons of the pilot nothing is known of such a map. How much it bends is estimated from their
/// differences over their distances, and this estimate is too small if the distances are long, as in a pass of
/// many more photons. Where the scatter is a fifth or more, footprints are no larger than the published ones.
/// Their area is bounded in inverse proportion to the scatter, so that they do not change at once.
///
/// @param least  lower bound of s
[[nodiscard]] inline Symmetric2 bounded_by_scatter(const Symmetric2& s, double scatter, double least) {
    constexpr double large = 0.2;
    const double area = std::sqrt(s.determinant()); // in u0², over π
    const double limit = square((std::max)(default_smoothing, least)) * (std::max)(1.0, large / scatter);
    return area > limit ? (limit / area) * s : s;
}

} // namespace nephroid::detail
