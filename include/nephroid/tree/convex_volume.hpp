// SPDX-License-Identifier: MIT
/// @file  Convex volumes for searching a tree: the intersection of a few half spaces and a box.
#pragma once

#include "nephroid/tree/volume.hpp"
#include "nephroid/vector/algebra.hpp"

namespace nephroid {

/// The half space where normal · x <= offset.
template <Scalar T>
struct HalfSpace {
    std::array<T, 3> normal; ///< outwards, of any length; 0 if all of space is inside
    T offset;
};

/// The intersection of a box and N half spaces. A tree's box overlaps it unless it lies outside the box or beyond one
/// of the planes, with a margin for rounding. So few boxes are reported that do not overlap the volume.
template <Scalar T, std::size_t N>
struct ConvexVolume {
    Box<T> box; ///< holds the whole volume, relative to the tree's origin
    std::array<HalfSpace<T>, N> planes;

    [[nodiscard]] constexpr bool overlaps(const Box<T>& other) const {
        int overlap = int(box.overlaps(other));
        for (const HalfSpace<T>& plane : planes) {
            // The innermost corner of the box. The size of the terms bounds the rounding of their sum.
            T least = -plane.offset, size = abs(plane.offset);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const T low = plane.normal[axis] * other.low[axis], high = plane.normal[axis] * other.high[axis];
                const T inner = low < high ? low : high;
                least = least + inner;
                size = size + abs(inner);
            }
            overlap &= int(!(least > T(8) * std::numeric_limits<T>::epsilon() * size));
        }
        return bool(overlap);
    }
};

namespace detail {
template <Scalar T>
using Triple = std::array<T, 3>;

template <Vector3 V>
[[nodiscard]] Triple<scalar_t<V>> components(const V& v) {
    using t = vector_traits<V>;
    return {t::x(v), t::y(v), t::z(v)};
}

template <Vector3 V>
[[nodiscard]] HalfSpace<scalar_t<V>> half_space(const V& normal, const scalar_t<V>& offset) {
    return {components(normal), offset};
}

/// A box around a ball, enlarged by as much as rounding could leave outside.
template <Scalar T>
[[nodiscard]] Box<T> box_about(const Triple<T>& position, T radius) {
    Box<T> box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const T grown = radius + T(4) * std::numeric_limits<T>::epsilon() * (radius + abs(position[axis]));
        box.low[axis] = position[axis] - grown;
        box.high[axis] = position[axis] + grown;
    }
    return box;
}
} // namespace detail

/// A flat prism: all points within `thickness` of a triangle's plane that project into the triangle. If the triangle
/// has no area (collinear corners), only the box bounds the volume.
///
/// @param a, b, c    corners, relative to the tree's origin, in either order
/// @param thickness  >= 0, to either side
template <Vector3 V>
[[nodiscard]] ConvexVolume<scalar_t<V>, 5> thick_triangle(const V& a, const std::type_identity_t<V>& b,
                                                          const std::type_identity_t<V>& c,
                                                          const scalar_t<V>& thickness) {
    using T = scalar_t<V>;
    ConvexVolume<T, 5> volume{detail::box_about(detail::components(a), thickness), {}};
    volume.box.add(detail::box_about(detail::components(b), thickness));
    volume.box.add(detail::box_about(detail::components(c), thickness));
    const V across = cross(V(b - a), V(c - a));
    if (!(largest_component(across) > T(0)))
        return volume; // half spaces with normal 0 contain everything
    const V n = direction_of(across);
    // The normal's relative error is that of the edges times the triangle's slenderness.
    const T edge = (std::max)(largest_component(V(b - a)), largest_component(V(c - a)));
    const T slenderness = T(1) + square(edge) / largest_component(across);
    const T slack = T(64) * std::numeric_limits<T>::epsilon() * (largest_component(a) + edge + thickness) * slenderness;
    const auto beside = [&](const V& from, const V& to) {
        const V outwards = cross(direction_of(V(to - from)), n);
        return detail::half_space(outwards, dot(outwards, from) + slack);
    };
    volume.planes = {beside(a, b), beside(b, c), beside(c, a), detail::half_space(n, dot(n, a) + thickness + slack),
                     detail::half_space(V(-n), thickness + slack - dot(n, a))};
    return volume;
}

/// The frustum around a flight whose radius changes linearly: it contains every ball around a point of the flight with
/// the radius there, and little more. It has six planes; four of them touch the balls at the ends.
///
/// @param from, to                 relative to the tree's origin
/// @param radius_from, radius_to   >= 0
template <Vector3 V>
[[nodiscard]] ConvexVolume<scalar_t<V>, 6> frustum_about(const V& from, const std::type_identity_t<V>& to,
                                                         const scalar_t<V>& radius_from, const scalar_t<V>& radius_to) {
    using T = scalar_t<V>;
    ConvexVolume<T, 6> volume{detail::box_about(detail::components(from), radius_from), {}};
    volume.box.add(detail::box_about(detail::components(to), radius_to));
    const V way(to - from);
    const T distance = length(way), narrowing = radius_from - radius_to;
    if (!(distance > abs(narrowing)))
        return volume; // one ball contains the other, and only the box bounds the volume
    const V ahead = T(1) / distance * way;
    const V helper =
        abs(vector_traits<V>::x(ahead)) < T(0.6) ? make_vector<V>(T(1), T(0), T(0)) : make_vector<V>(T(0), T(1), T(0));
    const V right = normalize(cross(ahead, helper)), up = cross(right, ahead);
    // The component along the flight of the normal of a plane that touches both balls.
    const T sine = narrowing / distance, cosine = sqrt((T(1) - sine) * (T(1) + sine));
    const auto touching = [&](const V& normal) {
        const T first = dot(normal, from) + radius_from, second = dot(normal, to) + radius_to;
        const T size = largest_component(from) + largest_component(to) + radius_from + radius_to;
        const T slack = T(64) * std::numeric_limits<T>::epsilon() * size;
        return detail::half_space(normal, (first > second ? first : second) + slack);
    };
    const V slope = sine * ahead;
    volume.planes = {touching(V(slope + cosine * right)),
                     touching(V(slope - cosine * right)),
                     touching(V(slope + cosine * up)),
                     touching(V(slope - cosine * up)),
                     touching(ahead),
                     touching(-ahead)};
    return volume;
}

} // namespace nephroid
