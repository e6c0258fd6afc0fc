// SPDX-License-Identifier: MIT
/// @file  Finds the folds of a caustic along a photon's last flight.
#pragma once

#include "common/numerics/chain.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

namespace nephroid::examples::numerics {

/// A flight to a point where the determinant of the footprint is 1e-3 to 1e-7 of the product of its lengths.
///
/// @param draw_offset  returns how far from the fold the point is, as a signed part of the distance; called for a fold
///                     that a flight can reach
/// @return  nothing if a flight reaches no fold, or the point is not that close to it
template <class DrawOffset>
[[nodiscard]] std::optional<double> distance_to_fold(const Chain& chain, const DrawOffset& draw_offset) {
    Steady steady;
    Line<Dual> ray = dual_emission(chain, steady);
    for (std::size_t i = 0; i < chain.surfaces.size(); ++i) {
        const Surface<Dual> s = lift<Dual>(chain.surfaces[i], steady);
        const Meeting<Dual> m = meet(s, ray, chain.meetings[i]);
        ray = {m.position, turned(s, ray.w, m.shade)};
    }
    const Tangents t = tangents_of(ray);
    const Point<double> w = lift<double>(Point<double>{ray.w.x.value, ray.w.y.value, ray.w.z.value});
    const auto footprint_at = [&](double flown) {
        return std::array<Point<double>, 2>{(t.d_position[0] + flown * t.d_direction[0]).across(w),
                                            (t.d_position[1] + flown * t.d_direction[1]).across(w)};
    };
    const auto det = [&](double flown) {
        const auto [a, b] = footprint_at(flown);
        return w.dot(a.cross(b));
    };
    // The determinant is a quadratic function of the distance.
    const double c = det(0), sum = det(1), difference = det(-1);
    const double a2 = 0.5 * (sum + difference) - c, a1 = 0.5 * (sum - difference);
    const double under = a1 * a1 - 4 * a2 * c;
    if (!(under > 0))
        return std::nullopt;
    const double q = -0.5 * (a1 + (a1 < 0 ? -1 : 1) * std::sqrt(under));
    for (const double fold : {q / a2, c / q}) {
        if (!(fold > 0.1 && fold < 20))
            continue;
        const double there = fold * (1 + draw_offset());
        const auto [a, b] = footprint_at(there);
        const double ratio = std::abs(det(there)) / (a.length() * b.length());
        if (ratio > 1e-7 && ratio < 1e-3)
            return there;
    }
    return std::nullopt;
}

} // namespace nephroid::examples::numerics
