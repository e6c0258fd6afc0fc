// SPDX-License-Identifier: MIT
/// @file  The target of a light: a sphere around the specular objects, and the cone that it fills from a point.
#pragma once

#include "nephroid/emission/cone.hpp"
#include "nephroid/vector/error.hpp"

#include <algorithm>
#include <concepts>
#include <limits>
#include <ranges>
#include <type_traits>

namespace nephroid {

/// Bounds of the objects that photons should reach. A light that is aimed at them sends the same flux to each point
/// inside as without a target, and no photons (or few) elsewhere.
template <Vector3 V>
struct BoundingSphere {
    V centre;
    scalar_t<V> radius; ///< world units, > 0
};

/// Optional: `light.aimed_at(sphere)` returns the same light, aimed at a sphere. All lights that come along have it.
template <class L, class V>
concept AimsAt = requires(const L& light, const BoundingSphere<V>& target) {
    { light.aimed_at(target) } -> std::same_as<L>;
};

/// A sphere that contains all points. Its centre is the centre of their box, and its radius is a few units in the last
/// place larger than the distance to the furthest point. It is at most sqrt(3) times as wide as the smallest sphere;
/// for the corners of a box it is the smallest.
///
/// @param points  a range of vectors, finite, at least one; otherwise std::invalid_argument. Vertices of what is inside
///                are better than corners of its box, whose sphere is up to sqrt(3) times as wide and gets three times
///                as many photons. Objects that are far apart make better targets one by one
///                (emission/target_groups.hpp). The sphere of a single point has radius 0, which no light accepts
template <std::ranges::forward_range R>
    requires Vector3<std::ranges::range_value_t<R>>
[[nodiscard]] BoundingSphere<std::ranges::range_value_t<R>> bounding_sphere(const R& points) {
    using V = std::ranges::range_value_t<R>;
    using T = scalar_t<V>;
    using t = vector_traits<V>;
    if (std::ranges::begin(points) == std::ranges::end(points))
        invalid_argument("nephroid::bounding_sphere: no points; pass at least two that differ");

    V low = *std::ranges::begin(points), high = low;
    for (const V& p : points) {
        if (!all_finite(p))
            invalid_argument("nephroid::bounding_sphere: a point is not finite; pass finite bounds");
        low = t::make((std::min)(t::x(low), t::x(p)), (std::min)(t::y(low), t::y(p)), (std::min)(t::z(low), t::z(p)));
        high =
            t::make((std::max)(t::x(high), t::x(p)), (std::max)(t::y(high), t::y(p)), (std::max)(t::z(high), t::z(p)));
    }
    const V centre = low + T(0.5) * (high - low);
    T radius = T(0);
    for (const V& p : points)
        radius = (std::max)(radius, length(V(p - centre)));
    return {centre, radius * (T(1) + T(8) * std::numeric_limits<T>::epsilon())};
}

/// The cone of directions from a point to the sphere. From a point inside it contains every direction, and its axis
/// points to the sphere's centre. Narrow cones are exact to a few units in the last place; very wide ones, from points
/// that almost touch the sphere, are less exact. Cones are rounded up, so that no direction is missed.
template <Vector3 V>
[[nodiscard]] Cone<V> cone_towards(const BoundingSphere<V>& target, const std::type_identity_t<V>& from) {
    using T = scalar_t<V>;
    const V towards = target.centre - from;
    const T distance = length(towards);
    if (!(distance > target.radius))
        return distance > T(0) ? every_direction<V>(T(1) / distance * towards) : every_direction<V>();
    constexpr T rounding = T(12) * std::numeric_limits<T>::epsilon(); // bounds the rounding of the sums below
    const T inverse = T(1) / distance;
    const T sine = target.radius * inverse;
    const T cosine2 = ((distance - target.radius) * inverse) * (T(1) + sine);
    const T cosine = sqrt((std::max)(T(0), cosine2 - rounding));
    return {inverse * towards, (T(1) + rounding) * sine * sine / (T(1) + cosine)}; // 1 − cos = sin² / (1 + cos)
}

} // namespace nephroid
