// SPDX-License-Identifier: MIT
/// @file  The part of a surface that a pixel sees around an eye path vertex: a parallelogram.
#pragma once

#include "nephroid/vector/frame.hpp"
#include "nephroid/vector/wide.hpp"

namespace nephroid {

/// The part of a surface that a pixel sees: the points x + a u + b v with |a|, |b| <= ½ around a vertex x. Both sides
/// are zero if it is unknown.
template <Vector3 V>
struct PixelFootprint {
    V u, v; ///< sides, in the surface's tangent plane, world units
};

/// The dual basis of a footprint's sides. A point x + d in the vertex's plane has the coordinates (u · d, v · d);
/// those of the footprint are the square from −½ to ½.
template <Vector3 V>
struct FootprintRows {
    V u, v;                   ///< 1 / world unit
    scalar_t<V> inverse_area; ///< of the parallelogram; 0, as the rows are, if there is none
};

/// A ray of a camera; its direction may be of any length.
template <Vector3 V>
struct PixelRay {
    V origin, direction;
};

namespace detail {
/// The footprint's dual basis, computed in the next wider scalar. Not finite if the sides span no area.
template <Vector3 V>
[[nodiscard]] FootprintRows<V> rows_of(const PixelFootprint<V>& footprint) {
    using W = wider_t<scalar_t<V>>;
    const Wide3<V> u = widened(footprint.u), v = widened(footprint.v), across = wide_cross<V>(u, v);
    const W area2 = wide_dot(across, across), inverse = W(1) / area2;
    return {narrowed<V>(inverse, wide_cross<V>(v, across)), narrowed<V>(inverse, wide_cross<V>(across, u)),
            scalar_t<V>(W(1) / sqrt(area2))};
}

/// The dual basis of a square with a given side, in an arbitrary rotation; all 0 for a side of 0.
template <Vector3 V>
[[nodiscard]] FootprintRows<V> square_rows(const V& normal, const scalar_t<V>& side) {
    using T = scalar_t<V>;
    if (!(side > T(0)))
        return {zero_vector<V>(), zero_vector<V>(), T(0)};
    const Frame<V> frame = frame_about(normal);
    const T inverse = T(1) / side;
    return {inverse * frame.u, inverse * frame.v, square(inverse)};
}

template <Vector3 V>
[[nodiscard]] bool is_unknown(const PixelFootprint<V>& footprint) {
    using T = scalar_t<V>;
    return largest_component(footprint.u) == T(0) && largest_component(footprint.v) == T(0);
}

/// The intersection of a ray with a plane, relative to a point of the plane, and its distance along the ray in lengths
/// of the ray's direction.
template <Vector3 V>
struct PlaneMeeting {
    Wide3<V> offset;
    wider_t<scalar_t<V>> distance;

    PlaneMeeting(const PixelRay<V>& ray, const V& point, const V& normal) {
        const Wide3<V> n = widened(normal), origin = widened(ray.origin), at = widened(point),
                       way = widened(ray.direction);
        const Wide3<V> back{origin[0] - at[0], origin[1] - at[1], origin[2] - at[2]};
        distance = -wide_dot(back, n) / wide_dot(way, n);
        offset = {back[0] + distance * way[0], back[1] + distance * way[1], back[2] + distance * way[2]};
    }
};
} // namespace detail

/// The footprint of a pixel that sees a vertex directly, from the intersections of the vertex's tangent plane with the
/// rays through the middles of the pixel's four sides. On a plane, the footprints of neighbouring pixels fit together
/// without gaps, except for the curvature of perspective.
///
/// @param position, normal          of the vertex
/// @param left, right, below, above  through the pixel's sides
/// @return  both sides are zero (unknown) if one of the rays does not meet the plane, as at the horizon
template <Vector3 V>
[[nodiscard]] PixelFootprint<V>
footprint_from_rays(const V& position, const std::type_identity_t<V>& normal,
                    const std::type_identity_t<PixelRay<V>>& left, const std::type_identity_t<PixelRay<V>>& right,
                    const std::type_identity_t<PixelRay<V>>& below, const std::type_identity_t<PixelRay<V>>& above) {
    using W = wider_t<scalar_t<V>>;
    bool meets = true;
    const auto side = [&](const PixelRay<V>& from, const PixelRay<V>& to) {
        const detail::PlaneMeeting<V> first(from, position, normal), second(to, position, normal);
        const V across =
            detail::narrowed<V>(W(1), {second.offset[0] - first.offset[0], second.offset[1] - first.offset[1],
                                       second.offset[2] - first.offset[2]});
        meets = meets && first.distance > W(0) && second.distance > W(0) && all_finite(across);
        return across;
    };
    const PixelFootprint<V> footprint{side(left, right), side(below, above)};
    return meets ? footprint : PixelFootprint<V>{zero_vector<V>(), zero_vector<V>()};
}

} // namespace nephroid
