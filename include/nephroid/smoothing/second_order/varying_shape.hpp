// SPDX-License-Identifier: MIT
/// @file  The shape of footprints at a photon, with its derivatives by the emission coordinates.
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

    /// The same tensors in other axes. The derivatives are still by the same u and v.
    ///
    /// @param axes  takes vectors in these axes to the other ones
    [[nodiscard]] VaryingShape rotated(const PlaneMatrix& axes) const {
        return {congruent(axes, value), congruent(axes, along_u), congruent(axes, along_v)};
    }

    /// Reduces the size alike in all directions: half the trace of S, the mean squared radius ρ², becomes less than
    /// m².
    ///
    /// S becomes S/√(1 + (ρ/m)⁴), which is smooth in both (see bound_along).
    /// @param slope  derivatives of the limit m by u and v
    void bound_size(double limit, Plane2 slope) {
        const double share = 0.5 * value.trace() / square(limit); // (ρ/m)²
        if (!(8 * share > 1))
            return;
        const double kept = 1 / std::sqrt(1 + square(share));
        const auto bound = [&](Symmetric2& along, double d_limit) {
            const double d_share = 0.5 * along.trace() / square(limit) - 2 * share * d_limit / limit;
            along = kept * along + (-kept * kept * kept * share * d_share) * value;
        };
        bound(along_u, slope.x);
        bound(along_v, slope.y);
        value = kept * value;
    }

    /// Reduces the radius ρ along a unit direction n, ρ² = n·S n, to less than a limit m, and keeps it across.
    ///
    /// ρ becomes (ρ⁻⁴ + m⁻⁴)^(−1/4), which is smooth in both. With the lesser of the two instead, the shift
    /// would jump where they are equal, and the light would have an edge there. Limits of 2.83 ρ or more, which would
    /// shorten ρ by 0.4% or less, change nothing.
    /// @param slope  derivatives of the limit by u and v
    void bound_along(Plane2 n, double limit, Plane2 slope) {
        const Plane2 s_n = value(n);
        const double radius2 = inner(n, s_n), limit2 = square(limit);
        if (!(limit2 < 8 * radius2))
            return;
        // S becomes S − (1 − kept)/ρ² · S n (S n)ᵀ; its derivatives follow by the product rule.
        const double sum4 = square(radius2) + square(limit2), root = std::sqrt(sum4), kept = limit2 / root;
        const double factor = (1 - kept) / radius2;
        const Symmetric2 outer = Symmetric2::outer(s_n);
        const auto bound = [&](Symmetric2& along, double d_limit) {
            const Plane2 d_s_n = along(n);
            const double d_radius2 = inner(n, d_s_n);
            const Symmetric2 d_outer{2 * s_n.x * d_s_n.x, s_n.x * d_s_n.y + s_n.y * d_s_n.x, 2 * s_n.y * d_s_n.y};
            const double d_kept = radius2 * (2 * limit * d_limit * radius2 - limit2 * d_radius2) / (sum4 * root);
            along += -factor * d_outer;
            along += ((d_kept + factor * d_radius2) / radius2) * outer;
        };
        bound(along_u, slope.x);
        bound(along_v, slope.y);
        value += -factor * outer;
    }
};

} // namespace nephroid::detail
