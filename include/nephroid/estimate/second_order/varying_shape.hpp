// SPDX-License-Identifier: MIT
/// @file  The shape of footprints about a photon: there, and how it changes with where photons are emitted.
#pragma once

#include "nephroid/vector/plane.hpp"

namespace nephroid {

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

    /// Reduces the radius along a unit direction to `most` where it is larger, and leaves it across as it is.
    ///
    /// S − (1 − most²/ρ²) w wᵀ with w = S n / ρ, ρ² = n·S n, and what that becomes where S and `most` change.
    /// @param slope  of `most`, by u and v
    void bound_along(Plane2 n, double most, Plane2 slope) {
        const Plane2 s_n = value(n);
        const double radius2 = inner(n, s_n);
        if (!(radius2 > most * most))
            return;
        const Symmetric2 cut = Symmetric2::outer(s_n); // ρ² w wᵀ
        const double kept = most * most / radius2, by = (1 - kept) / radius2;
        const auto bound = [&](Symmetric2& along, double d_most) {
            const Plane2 d_s_n = along(n);
            const double d_radius2 = inner(n, d_s_n);
            const Symmetric2 d_cut{2 * s_n.x * d_s_n.x, s_n.x * d_s_n.y + s_n.y * d_s_n.x, 2 * s_n.y * d_s_n.y};
            const double d_kept = (2 * most * d_most - kept * d_radius2) / radius2;
            const double d_by = (-d_kept - by * d_radius2) / radius2;
            along += -by * d_cut;
            along += -d_by * cut;
        };
        bound(along_u, slope.x);
        bound(along_v, slope.y);
        value += -by * cut;
    }
};

} // namespace nephroid
