// SPDX-License-Identifier: MIT
/// @file  Curvature: how a surface's normal changes along the surface, in the four forms that renderers know.
///
/// Each form is a function from the displacement of a hit point in the tangent plane, dx, to the change of the
/// *shading* normal, dn. A hit has one as its member `curvature`; a scene with several kinds of surface uses
/// `AnyCurvature`. Where the walk flips a normal to face the ray, it flips dn as well.
#pragma once

#include "nephroid/differential/interpolated_curvature.hpp"
#include "nephroid/vector/algebra.hpp"

#include <algorithm>
#include <concepts>
#include <limits>
#include <variant>

namespace nephroid {

/// `curvature(dx)` returns dn, the change of the shading normal.
///
/// ```cpp
/// struct Bumps { // a renderer's own: a plane z = 0 with the normal of z = a sin(k x)
///     float a, k, x;
///     Vec3 operator()(const Vec3& d_position) const { // by the chain rule; exact where the slope is small
///         return Vec3(a * k * k * sin(k * x) * d_position.x, 0, 0);
///     }
/// };
/// ```
template <class C, class V>
concept Curvature = Vector3<V> && requires(const C curvature, const V d_position) {
    { curvature(d_position) } -> std::convertible_to<V>;
};

/// The shading normal is constant, as on a plane or a flat-shaded triangle. The library never assumes this by itself.
struct Flat {
    template <Vector3 V>
    [[nodiscard]] constexpr V operator()(const V&) const {
        return zero_vector<V>();
    }
};

/// The derivative of a unit normal as a linear map, dn = S dx: for surfaces that know their curvature exactly.
template <Vector3 V>
struct ShapeOperator {
    V column_x, column_y, column_z; ///< S = [column_x column_y column_z], 1 / length

    [[nodiscard]] V operator()(const V& d_position) const {
        using t = vector_traits<V>;
        return t::x(d_position) * column_x + (t::y(d_position) * column_y + t::z(d_position) * column_z);
    }
};

/// The shape operator with principal directions e1, e2 (unit, orthogonal) and principal curvatures k1, k2 in
/// 1 / length; positive where the surface curves away from its normal, as a sphere's outward one: k1 = k2 = 1/R.
template <Vector3 V>
[[nodiscard]] ShapeOperator<V> principal_curvatures(const V& e1, scalar_t<V> k1, const V& e2, scalar_t<V> k2) {
    using t = vector_traits<V>;
    const auto column = [&](scalar_t<V> along_1, scalar_t<V> along_2) -> V {
        return (k1 * along_1) * e1 + (k2 * along_2) * e2;
    };
    return {column(t::x(e1), t::x(e2)), column(t::y(e1), t::y(e2)), column(t::z(e1), t::z(e2))};
}

/// The shape operator of a sphere with the outward normal; for a negative radius, with the inward normal.
template <Vector3 V>
[[nodiscard]] ShapeOperator<V> sphere_curvature(scalar_t<V> radius) {
    using T = scalar_t<V>;
    const T k = T(1) / radius, zero(0);
    return {make_vector<V>(k, zero, zero), make_vector<V>(zero, k, zero), make_vector<V>(zero, zero, k)};
}

/// A surface of parameters u, v with derivatives of position and of the (unit) shading normal, as pbrt and Mitsuba
/// hits carry them. dx = a dpdu + b dpdv is solved in the least-squares sense.
template <Vector3 V>
struct ParametricCurvature {
    V dpdu, dpdv;
    V dndu, dndv;

    /// Where dpdu and dpdv are parallel (the pole of a sphere, degenerate uv), only the longer one is used; where both
    /// vanish, the change of the normal is unknown and dn is zero.
    [[nodiscard]] V operator()(const V& d_position) const {
        using T = scalar_t<V>;
        return isfinite(T(length2(dpdu) * length2(dpdv))) ? solve(d_position) : in_range().solve(d_position);
    }

private:
    [[nodiscard]] V solve(const V& d_position) const {
        using T = scalar_t<V>;
        const T uu = length2(dpdu), vv = length2(dpdv);
        // Cross products keep their digits in sheared coordinates, where the Gram matrix would lose them.
        const V across = cross(dpdu, dpdv);
        const T gram = length2(across); // uu vv sin²
        if (gram > square(T(16) * std::numeric_limits<T>::epsilon()) * uu * vv) {
            const T a = dot(cross(d_position, dpdv), across) / gram;
            const T b = dot(cross(dpdu, d_position), across) / gram;
            return a * dndu + b * dndv;
        }
        if (!(uu > T(0)) && !(vv > T(0)))
            return zero_vector<V>();
        return uu >= vv ? V((dot(d_position, dpdu) / uu) * dndu) : V((dot(d_position, dpdv) / vv) * dndv);
    }

    /// The same surface with its parameters rescaled so that derivatives are about 1, because their squares overflow.
    [[nodiscard]] ParametricCurvature in_range() const {
        const auto scale = [](const V& d) { return scalar_t<V>(1) / (std::max)(scalar_t<V>(1), largest_component(d)); };
        const scalar_t<V> u = scale(dpdu), v = scale(dpdv);
        return {u * dpdu, v * dpdv, u * dndu, v * dndv};
    }
};

/// The curvature of a hit on any of several kinds of surface: a std::variant.
template <class... Kinds>
struct AnyCurvature : std::variant<Kinds...> {
    using std::variant<Kinds...>::variant;

    template <Vector3 V>
        requires(Curvature<Kinds, V>&&...)
    [[nodiscard]] V operator()(const V& d_position) const {
        return std::visit([&](const auto& kind) -> V { return kind(d_position); },
                          static_cast<const std::variant<Kinds...>&>(*this));
    }
};

} // namespace nephroid
