// SPDX-License-Identifier: MIT
/// @file  The hit of a ray: where it is, which way the surface faces, and how the surface's normal changes.
#pragma once

#include "nephroid/differential/curvature.hpp"

#include <cstdint>

namespace nephroid {

/// A hit, ready to fill in. Any struct with these member names will do as well. `position` may be left out (it is then
/// origin + distance · direction), and so may `shading_normal` (it is then the geometric normal).
///
/// @tparam C  how the shading normal changes: Flat, ShapeOperator, ParametricCurvature, InterpolatedCurvature,
///            AnyCurvature of several of them, or your own type (differential/curvature.hpp)
///
/// ```cpp
/// struct MyHit { // a renderer's own: these names, and whatever else it likes
///     float distance;
///     Vec3 geometric_normal;
///     nephroid::ParametricCurvature<Vec3> curvature; // {dpdu, dpdv, dndu, dndv}
///     float position_error;
///     const Material* material;
/// };
/// ```
template <Vector3 V, Curvature<V> C>
struct SurfaceHit {
    scalar_t<V> distance;        ///< along the unit direction, world units
    V position;                  ///< on the surface
    V geometric_normal;          ///< unit, of the surface that is really hit; tells from which side the ray comes
    V shading_normal;            ///< unit, on the geometric normal's side; reflection and refraction use this one
    C curvature;                 ///< dn = curvature(dx), for the shading normal as given (the walk flips both)
    scalar_t<V> position_error;  ///< bound on the distance from `position` to the surface, world units, >= 0
    std::size_t surface = 0;     ///< number of the smooth surface that was hit: of the object, not of its material
                                 ///< or a triangle. Photons that met the same surfaces may be neighbours
                                 ///< (transport/trail.hpp)
    std::uint64_t primitive = 0; ///< number of the triangle or shape; only scenes with Contacts need it
                                 ///< (transport/contacts.hpp)
};

template <class H, class V>
concept HasDistance = requires(const H hit) {
    { hit.distance } -> std::convertible_to<scalar_t<V>>;
};

template <class H, class V>
concept HasGeometricNormal = requires(const H hit) {
    { hit.geometric_normal } -> std::convertible_to<V>;
};

/// `hit.curvature(dx)` gives the change of the normal along the surface. `nephroid::Flat curvature;` is right for
/// planes and flat triangles; on a curved surface it renders a wrong caustic.
template <class H, class V>
concept HasCurvature = requires(const H hit, const V d_position) {
    { hit.curvature(d_position) } -> std::convertible_to<V>;
};

template <class H, class V>
concept HasPosition = requires(const H hit) {
    { hit.position } -> std::convertible_to<V>;
};

template <class H, class V>
concept HasShadingNormal = requires(const H hit) {
    { hit.shading_normal } -> std::convertible_to<V>;
};

template <class H, class V>
concept HasPositionError = requires(const H hit) {
    { hit.position_error } -> std::convertible_to<scalar_t<V>>;
};

template <class H, class V>
concept Hit = Vector3<V> && HasDistance<H, V> && HasGeometricNormal<H, V> && HasCurvature<H, V>;

/// The usual bound for `position_error`: a careful intersection routine that computes origin + distance · direction
/// comes this close to the surface. Eight roundings of the largest coordinates involved.
template <Vector3 V>
[[nodiscard]] scalar_t<V> rounding_error(const V& origin, scalar_t<V> distance, const V& position) {
    using T = scalar_t<V>;
    using t = vector_traits<V>;
    const auto largest = [](const V& v) { return (std::max)({abs(T(t::x(v))), abs(T(t::y(v))), abs(T(t::z(v)))}); };
    return T(8) * std::numeric_limits<T>::epsilon() * (largest(origin) + largest(position) + abs(distance));
}

} // namespace nephroid
