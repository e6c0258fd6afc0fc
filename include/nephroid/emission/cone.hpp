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

/// All directions. The axis should point to where photons are wanted: neighbours are close together around it, and
/// furthest apart opposite to it, where the whole edge of the square becomes one direction.
template <Vector3 V>
[[nodiscard]] Cone<V> every_direction(const V& axis) {
    return {axis, scalar_t<V>(2)};
}

/// All directions, around an axis that is at least 50 degrees away from the coordinate axes, on which scenes are often
/// built.
template <Vector3 V>
[[nodiscard]] Cone<V> every_direction() {
    using T = scalar_t<V>;
    return every_direction(make_vector<V>(T(0.64), T(0.48), T(0.6)));
}

/// A direction uniform in the cone, unit.
///
/// @param frame  about the cone's axis
/// @param u1,u2  in [0, 1]; the direction changes continuously with them
template <Vector3 V>
[[nodiscard]] V direction_in(const Cone<V>& cone, const Frame<V>& frame, scalar_t<V> u1, scalar_t<V> u2) {
    return cap_direction(cone.axis, frame, cone.height, concentric_disk(u1, u2));
}

/// How a pair of coordinates is mapped: where the map has kinks, and what lies at the edges of the square.
struct EmissionPair {
    Kinks kinks = Kinks::nowhere;
    DomainEdge edges = DomainEdge::ends;
};

/// How `direction_in` maps the square to a cone.
template <Vector3 V>
[[nodiscard]] EmissionPair direction_pair(const Cone<V>& cone) {
    return {Kinks::diagonals, cone.is_everything() ? DomainEdge::closes : DomainEdge::ends};
}

} // namespace nephroid
