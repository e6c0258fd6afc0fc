// SPDX-License-Identifier: MIT
/// @file  How photons in the same place move apart: in which direction, and by what measure of length.
#pragma once

#include "nephroid/sequence/hash.hpp"
#include "nephroid/tree/point_tree.hpp"
#include "nephroid/vector/frame.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace nephroid::detail {

/// A unit vector in the tangent plane for one photon of a pair in the same place, and its opposite for the other.
///
/// Where two photons coincide, eq. 1 of Spencer and Jones 2009 gives the force a size, r τ, but no direction. This one
/// is random, and depends on the photons' indices alone.
template <class Cloud>
[[nodiscard]] typename Cloud::vector separation_direction(const Cloud& cloud, std::size_t slot, std::size_t other) {
    using V = typename Cloud::vector;
    using T = scalar_t<V>;
    const std::uint32_t i = cloud.tree().index(slot), j = cloud.tree().index(other);
    const std::size_t first = i < j ? slot : other;
    const double angle = 2 * pi<double> * uniform_from_bits<double>(hash_bits((std::min)(i, j), (std::max)(i, j)));
    const Frame<V> frame = frame_about(cloud.normal(first));
    const V direction = T(std::cos(angle)) * frame.u + T(std::sin(angle)) * frame.v;
    return i < j ? direction : -direction;
}

/// Whether two photons lie in one place, on one surface.
template <class Cloud>
[[nodiscard]] bool coincide(const Cloud& cloud, std::size_t a, std::size_t b) {
    using V = typename Cloud::vector;
    return length2(V(cloud.position(a) - cloud.position(b))) == typename Cloud::T(0) &&
           length2(V(cloud.normal(a) - cloud.normal(b))) == typename Cloud::T(0);
}

/// The distance from photons that coincide to the nearest one on their surface that does not; 0 if there is none.
template <class Cloud>
[[nodiscard]] typename Cloud::T distance_to_others(const Cloud& cloud, std::size_t slot) {
    using V = typename Cloud::vector;
    using T = typename Cloud::T;
    const Box<T> bounds = cloud.tree().bounds();
    if (bounds.low == bounds.high)
        return T(0); // all in one place: each would look at all
    const V position = cloud.position(slot);
    std::array<Neighbour<T>, 1> nearest;
    const auto elsewhere = [&](std::size_t other) {
        return length2(V(cloud.position(other) - position)) > T(0) && cloud.same_surface(slot, other);
    };
    const std::size_t found = cloud.tree().nearest(position, nearest, std::numeric_limits<T>::infinity(), elsewhere);
    return found > 0 ? sqrt(nearest[0].distance2) : T(0);
}

} // namespace nephroid::detail
