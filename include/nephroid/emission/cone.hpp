// SPDX-License-Identifier: MIT
/// @file  A cone of directions, and directions drawn uniformly from it.
#pragma once

#include "nephroid/emission/domain.hpp"
#include "nephroid/emission/warp.hpp"

namespace nephroid {

/// Directions within an angle of an axis.
template <Vector3 V>
struct Cone {
    V axis;             ///< unit
    scalar_t<V> height; ///< 1 − cos(half angle), in [0, 2]; 2 is every direction

    /// Steradian, in [0, 4π].
    [[nodiscard]] scalar_t<V> solid_angle() const { return scalar_t<V>(2) * pi<scalar_t<V>> * height; }
    [[nodiscard]] bool is_everything() const { return height >= scalar_t<V>(2); }
};

template <Vector3 V>
[[nodiscard]] Cone<V> every_direction() {
    using T = scalar_t<V>;
    return {make_vector<V>(T(0), T(0), T(1)), T(2)};
}

/// A direction uniform in the cone, unit.
///
/// @param frame  about the cone's axis
/// @param u1,u2  in [0, 1]; the direction changes continuously with them
template <Vector3 V>
[[nodiscard]] V direction_in(const Cone<V>& cone, const Frame<V>& frame, scalar_t<V> u1, scalar_t<V> u2) {
    return cone.is_everything() ? sphere_direction<V>(u1, u2)
                                : cap_direction(cone.axis, frame, cone.height, concentric_disk(u1, u2));
}

/// How a pair of coordinates is mapped: its kinks, and what lies at its edges.
struct EmissionPair {
    Kinks kinks = Kinks::nowhere;
    DomainEdge edges = DomainEdge::ends;
};

/// How `direction_in` maps the square to a cone.
template <Vector3 V>
[[nodiscard]] EmissionPair directions_of(const Cone<V>& cone) {
    return cone.is_everything() ? EmissionPair{Kinks::octahedron, DomainEdge::folds}
                                : EmissionPair{Kinks::diagonals, DomainEdge::ends};
}

} // namespace nephroid
