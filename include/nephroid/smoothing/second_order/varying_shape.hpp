// SPDX-License-Identifier: MIT
/// @file  The shape of footprints about a photon: there, and how it changes with where photons are emitted.
#pragma once

#include "nephroid/vector/plane.hpp"
#include "nephroid/vector/scalar.hpp"

#include <cmath>

namespace nephroid::detail {

/// S and its derivatives by the two emission coordinates u and v, all in the axes of one frame.
struct VaryingShape {
    Symmetric2 value{}, along_u{}, along_v{};

    void add(double weight, const VaryingShape& o) {
        value += weight * o.value;
        along_u += weight * o.along_u;
        along_v += weight * o.along_v;
    }

    /// By other axes, of which `axes` makes these; u and v stay what they are.
    [[nodiscard]] VaryingShape turned(const PlaneMatrix& axes) const {
        return {congruent(axes, value), congruent(axes, along_u), congruent(axes, along_v)};
    }

    /// Reduces the radius ρ along a unit direction, ρ² = n·S n, to less than `most`, and leaves it across as it is.
    ///
    /// ρ becomes (ρ⁻⁴ + most⁻⁴)^(−1/4): where the lesser of the two had a bend, the shift would have a
    /// step, and the light an edge. A `most` of 2.9 ρ and more, which would shorten it by 0.4%, changes nothing.
    /// @param slope  of `most`, by u and v
    void bound_along(Plane2 n, double most, Plane2 slope) {
        const Plane2 s_n = value(n);
        const double radius2 = inner(n, s_n), most2 = square(most);
        if (!(most2 < 8 * radius2))
            return;
        // S − (1 − kept)/ρ² · S n (S n)ᵀ, and what that becomes where S and `most` change.
        const double sum4 = square(radius2) + square(most2), root = std::sqrt(sum4), kept = most2 / root;
        const double by = (1 - kept) / radius2;
        const Symmetric2 cut = Symmetric2::outer(s_n);
        const auto bound = [&](Symmetric2& along, double d_most) {
            const Plane2 d_s_n = along(n);
            const double d_radius2 = inner(n, d_s_n);
            const Symmetric2 d_cut{2 * s_n.x * d_s_n.x, s_n.x * d_s_n.y + s_n.y * d_s_n.x, 2 * s_n.y * d_s_n.y};
            const double d_kept = radius2 * (2 * most * d_most * radius2 - most2 * d_radius2) / (sum4 * root);
            along += -by * d_cut;
            along += ((d_kept + by * d_radius2) / radius2) * cut;
        };
        bound(along_u, slope.x);
        bound(along_v, slope.y);
        value += -by * cut;
    }
};

} // namespace nephroid::detail
