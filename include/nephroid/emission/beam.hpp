// SPDX-License-Identifier: MIT
/// @file  The patches that collimated beams start from, and the smallest patch that lights given points.
#pragma once

#include "nephroid/emission/target.hpp"
#include "nephroid/vector/frame.hpp"

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <ranges>
#include <variant>
#include <vector>

namespace nephroid {

/// A disk across the beam.
template <Vector3 V>
struct BeamDisk {
    V centre;
    scalar_t<V> radius; ///< world units, > 0
};

/// The parallelogram corner + [0, 1] edge_u + [0, 1] edge_v; it need not be perpendicular to the beam.
template <Vector3 V>
struct Parallelogram {
    V corner;
    V edge_u;
    V edge_v;
};

/// The patch that a beam starts from. A sphere stands for the disk of its radius in front of it (`beam_over`).
template <Vector3 V>
using BeamPatch = std::variant<BoundingSphere<V>, BeamDisk<V>, Parallelogram<V>>;

namespace detail {
/// The distance from the bounds at which a beam starts: a fraction of their size, plus the rounding of coordinates.
template <Vector3 V>
[[nodiscard]] scalar_t<V> beam_margin(const V& centre, scalar_t<V> size) {
    using T = scalar_t<V>;
    return size / T(64) + T(8) * std::numeric_limits<T>::epsilon() * length(centre);
}

/// A point's coordinates across a beam and along it, relative to some origin.
template <Scalar T>
struct BeamCoordinates {
    T x, y;
    T along;
};

/// The convex hull of points in the plane, counter-clockwise, without points on its edges; sorts the points.
/// Source: Andrew 1979, "Another efficient algorithm for convex hulls in two dimensions".
template <Scalar T>
[[nodiscard]] std::vector<BeamCoordinates<T>> convex_hull(std::vector<BeamCoordinates<T>>& points) {
    const auto turns_left = [](const auto& a, const auto& b, const auto& c) {
        return difference_of_products<T>(b.x - a.x, c.y - a.y, b.y - a.y, c.x - a.x) > T(0);
    };
    std::sort(points.begin(), points.end(),
              [](const auto& a, const auto& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });

    std::vector<BeamCoordinates<T>> hull;
    const auto add_chain = [&](auto from, auto to) {
        const std::size_t start = hull.size();
        for (; from != to; ++from) {
            while (hull.size() >= start + 2 && !turns_left(hull[hull.size() - 2], hull.back(), *from))
                hull.pop_back();
            hull.push_back(*from);
        }
        hull.pop_back(); // it starts the other chain
    };
    add_chain(points.begin(), points.end());
    add_chain(points.rbegin(), points.rend());
    return hull;
}

/// A rectangle in the plane, with sides parallel and perpendicular to (cos, sin).
template <Scalar T>
struct Rectangle {
    T cos, sin;
    T low_x, high_x; ///< in the turned coordinates
    T low_y, high_y;

    [[nodiscard]] T area() const { return (high_x - low_x) * (high_y - low_y); }
};

/// The smallest rectangle around a convex polygon; one of its sides lies on a side of the polygon. Time
/// O(n²) for n corners.
/// Source: Freeman and Shapira 1975, "Determining the minimum-area encasing rectangle for an arbitrary closed curve".
template <Scalar T>
[[nodiscard]] Rectangle<T> smallest_rectangle(const std::vector<BeamCoordinates<T>>& hull) {
    Rectangle<T> smallest{};
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const BeamCoordinates<T> a = hull[i], b = hull[(i + 1) % hull.size()];
        const T dx = b.x - a.x, dy = b.y - a.y, side = sqrt(dx * dx + dy * dy);
        if (!(side > T(0)))
            continue;
        Rectangle<T> turned{dx / side,
                            dy / side,
                            (std::numeric_limits<T>::max)(),
                            std::numeric_limits<T>::lowest(),
                            (std::numeric_limits<T>::max)(),
                            std::numeric_limits<T>::lowest()};
        for (const BeamCoordinates<T>& p : hull) {
            const T x = turned.cos * p.x + turned.sin * p.y, y = turned.cos * p.y - turned.sin * p.x;
            turned.low_x = (std::min)(turned.low_x, x), turned.high_x = (std::max)(turned.high_x, x);
            turned.low_y = (std::min)(turned.low_y, y), turned.high_y = (std::max)(turned.high_y, y);
        }
        const bool is_first = smallest.cos == T(0) && smallest.sin == T(0);
        if (is_first || turned.area() < smallest.area())
            smallest = turned;
    }
    return smallest;
}
} // namespace detail

/// The disk perpendicular to a beam that lies in front of a sphere and covers it.
///
/// @param direction  of the beam, unit
template <Vector3 V>
[[nodiscard]] BeamDisk<V> beam_over(const V& direction, const BoundingSphere<V>& sphere) {
    const scalar_t<V> back = sphere.radius + detail::beam_margin(sphere.centre, sphere.radius);
    return {sphere.centre - back * direction, sphere.radius};
}

/// The smaller of a disk and a rectangle (in any rotation) that are perpendicular to a beam, lie in front of all points
/// and cover them.
///
/// @param direction  of the beam, any length but zero
/// @param points     corners of bounds, finite; at least two that do not lie on one line along the beam.
/// Throws std::invalid_argument for other points. For a flat target that is parallel to the beam, the patch's width is
/// a thousandth of its length.
template <Vector3 V, std::ranges::forward_range R>
    requires std::same_as<std::ranges::range_value_t<R>, V>
[[nodiscard]] BeamPatch<V> smallest_beam_over(const V& direction, const R& points) {
    using T = scalar_t<V>;
    const BoundingSphere<V> bounds = bounding_sphere(points);
    const T direction_length = length(direction);
    if (!(direction_length > T(0)) || !isfinite(direction_length))
        invalid_argument("nephroid::smallest_beam_over: the direction has no length or is not finite; pass any other");
    const V along = T(1) / direction_length * direction;
    const Frame<V> across = frame_about(along);

    std::vector<detail::BeamCoordinates<T>> projected;
    T nearest = T(0);
    for (const V& p : points) {
        const V from_centre = p - bounds.centre;
        projected.push_back({dot(from_centre, across.u), dot(from_centre, across.v), dot(from_centre, along)});
        nearest = (std::min)(nearest, projected.back().along);
    }
    const detail::Rectangle<T> box = detail::smallest_rectangle(detail::convex_hull(projected));
    const T side_x = box.high_x - box.low_x, side_y = box.high_y - box.low_y;
    const T longest = (std::max)(side_x, side_y);
    if (!(longest > T(64) * std::numeric_limits<T>::epsilon() * bounds.radius))
        invalid_argument("nephroid::smallest_beam_over: the points lie on one line along the beam, so that the beam "
                         "has no width; pass the corners of the target's bounds");

    const auto world = [&](T x, T y) -> V {
        return (box.cos * x - box.sin * y) * across.u + (box.sin * x + box.cos * y) * across.v;
    };
    const T back = nearest - detail::beam_margin(bounds.centre, bounds.radius);
    const T mid_x = box.low_x + T(0.5) * side_x, mid_y = box.low_y + T(0.5) * side_y;
    const V centre = bounds.centre + (back * along + world(mid_x, mid_y));
    T radius2 = T(0);
    for (const auto& p : projected) {
        const T x = box.cos * p.x + box.sin * p.y - mid_x, y = box.cos * p.y - box.sin * p.x - mid_y;
        radius2 = (std::max)(radius2, x * x + y * y);
    }

    // Rounding must leave no point outside: 16 units in the last place of the largest term.
    const T rounding = T(16) * std::numeric_limits<T>::epsilon() * bounds.radius;
    const T radius = sqrt(radius2) + rounding;
    const T width_x = (std::max)(side_x, longest / T(1000)) + T(2) * rounding;
    const T width_y = (std::max)(side_y, longest / T(1000)) + T(2) * rounding;
    if (pi<T> * square(radius) < width_x * width_y)
        return BeamDisk<V>{centre, radius};
    return Parallelogram<V>{centre - world(T(0.5) * width_x, T(0.5) * width_y), world(width_x, T(0)),
                            world(T(0), width_y)};
}

} // namespace nephroid
