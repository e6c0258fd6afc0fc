// SPDX-License-Identifier: MIT
/// @file  Rays, boxes and candidate hits: the types that shapes and the BVH share.
#pragma once

#include "nephroid/differential/curvature.hpp"
#include "nephroid/transport/contacts.hpp"
#include "nephroid/transport/hit.hpp"
#include "nephroid/vector/glm.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cstdint>
#include <limits>
#include <type_traits>

namespace nephroid::examples {

template <class T>
using Vec3 = glm::vec<3, T>;

/// Shapes intersect in double also where the scene's scalar is float: a float ray is exact there, so that the side of a
/// surface that a ray starts on is never lost to rounding. A scalar that is a class (a dual number) is wide enough.
template <class T>
using wide_t = std::conditional_t<std::is_same_v<T, float>, double, T>;

template <class T>
[[nodiscard]] Vec3<wide_t<T>> widen(const Vec3<T>& v) {
    return Vec3<wide_t<T>>(v);
}

/// a × b of vectors in `wide` that were made from T: double holds the products of float's differences almost exactly,
/// and only those of double's own can cancel.
template <class T>
[[nodiscard]] Vec3<wide_t<T>> wide_cross(const Vec3<wide_t<T>>& a, const Vec3<wide_t<T>>& b) {
    if constexpr (std::is_same_v<T, float>)
        return glm::cross(a, b);
    else
        return cross(a, b);
}

/// Hits count between t_min and t_max, in units of the direction's length.
template <class T>
struct Ray {
    Vec3<T> origin;
    Vec3<T> direction;
    T t_min = T(0);
    T t_max = std::numeric_limits<T>::infinity();
};

/// An axis-aligned box; empty by default.
template <class T>
struct Box {
    Vec3<T> min{std::numeric_limits<T>::infinity()};
    Vec3<T> max{-std::numeric_limits<T>::infinity()};

    [[nodiscard]] bool is_empty() const { return !(min.x <= max.x && min.y <= max.y && min.z <= max.z); }
    [[nodiscard]] bool contains(const Vec3<T>& p) const {
        return p.x >= min.x && p.y >= min.y && p.z >= min.z && p.x <= max.x && p.y <= max.y && p.z <= max.z;
    }
    [[nodiscard]] bool is_finite() const { return all_finite(min) && all_finite(max); }

    void add(const Vec3<T>& p) {
        for (int axis = 0; axis < 3; ++axis) {
            min[axis] = p[axis] < min[axis] ? p[axis] : min[axis];
            max[axis] = p[axis] > max[axis] ? p[axis] : max[axis];
        }
    }

    /// Adds a box; an empty one adds nothing.
    void add(const Box& box) {
        for (int axis = 0; axis < 3; ++axis) {
            min[axis] = box.min[axis] < min[axis] ? box.min[axis] : min[axis];
            max[axis] = box.max[axis] > max[axis] ? box.max[axis] : max[axis];
        }
    }

    /// The box and a few units in the last place around it: no corner computed in T is lost to rounding.
    [[nodiscard]] Box padded() const {
        const Vec3<T> margin = T(8) * std::numeric_limits<T>::epsilon() * (glm::abs(min) + glm::abs(max));
        return {min - margin, max + margin};
    }

    /// Half of the surface, 0 for an empty box.
    [[nodiscard]] T half_area() const {
        if (is_empty())
            return T(0);
        const Vec3<T> d = max - min;
        return d.x * d.y + d.y * d.z + d.z * d.x;
    }

    [[nodiscard]] Vec3<T> corner(int i) const {
        return {i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z};
    }
};

/// A hit as an intersection routine finds it: enough to rank it, and to fill in the rest if it is the nearest one.
template <class T>
struct Candidate {
    wide_t<T> distance;
    wide_t<T> u = 0, v = 0;      ///< barycentric coordinates, for triangles
    std::uint32_t primitive = 0; ///< index within the shape
};

/// Leaves out nothing; among surfaces that touch, any may come first. For rays that end where they hit.
struct AnyOrder {
    static constexpr bool matters = false;
};

/// Says which hits a search leaves out, and which of two hits at the same distance comes first.
///
/// @tparam Rank  rank(material, leaves): smaller ranks come first; `leaves` is whether the ray comes from inside
template <class T, class Rank>
struct ContactOrder {
    static constexpr bool matters = true;

    const Contacts<T>& contacts;
    Rank rank;
    std::uint64_t part = 0; ///< the upper half of primitives' numbers

    [[nodiscard]] bool was_left(std::uint32_t primitive) const { return contacts.was_left(part << 32 | primitive); }

    /// @param cosine  cosine() between the ray and the hit's normal, called only if it is needed
    template <class Cosine>
    [[nodiscard]] bool leaves_out(std::uint32_t primitive, const wide_t<T>& distance, const Cosine& cosine) const {
        const std::uint64_t number = part << 32 | primitive;
        return contacts.may_skip(number, T(distance)) && contacts.skips(number, T(distance), T(cosine()));
    }
};

/// The largest distance between hits that count as touching, along a ray perpendicular to them.
template <class T>
[[nodiscard]] wide_t<T> contact_height(const Ray<T>& ray, const wide_t<T>& distance) {
    using wide = wide_t<T>;
    const auto size = [](const Vec3<T>& v) { return abs(wide(v.x)) + abs(wide(v.y)) + abs(wide(v.z)); };
    return wide(8 * std::numeric_limits<T>::epsilon()) * (size(ray.origin) + abs(distance) * size(ray.direction));
}

template <class T>
using SurfaceCurvature = AnyCurvature<Flat, ShapeOperator<Vec3<T>>, InterpolatedCurvature<Vec3<T>>>;

template <class T>
using Hit = SurfaceHit<Vec3<T>, SurfaceCurvature<T>>;

/// A bound on the distance between a surface and a point that was computed on it in `wide` and rounded to T.
///
/// @param scale  the largest coordinates involved, which matter if T is as wide as the arithmetic
template <class T>
[[nodiscard]] T position_error(const Vec3<T>& position, const std::type_identity_t<wide_t<T>>& scale) {
    const T rounding = T(4) * std::numeric_limits<T>::epsilon() * (abs(position.x) + abs(position.y) + abs(position.z));
    return rounding + T(4 * std::numeric_limits<wide_t<T>>::epsilon() * scale);
}

/// The sum of a vector's components without sign: a cheap bound on its length.
template <class T>
[[nodiscard]] wide_t<T> magnitude(const Vec3<T>& v) {
    using wide = wide_t<T>;
    return abs(wide(v.x)) + abs(wide(v.y)) + abs(wide(v.z));
}

/// Makes the hit at a point of an analytic shape.
///
/// @param scale  of the shape, see `position_error`
template <class T, Curvature<Vec3<T>> C>
[[nodiscard]] Hit<T> make_hit(const wide_t<T>& distance, const Vec3<wide_t<T>>& position, const Vec3<wide_t<T>>& normal,
                              const C& curvature, const wide_t<T>& scale) {
    const Vec3<T> p(position), n(normal);
    return {T(distance), p, n, n, curvature, position_error(p, scale)};
}

/// The shape operator with these columns, rounded to T.
template <class T>
[[nodiscard]] ShapeOperator<Vec3<T>> make_shape_operator(const Vec3<wide_t<T>>& x, const Vec3<wide_t<T>>& y,
                                                         const Vec3<wide_t<T>>& z) {
    return {Vec3<T>(x), Vec3<T>(y), Vec3<T>(z)};
}

} // namespace nephroid::examples
