// SPDX-License-Identifier: MIT
/// @file  What the library asks of a ray's hit: where, which way the surface faces, and how its normal changes.
#pragma once

#include "nephroid/differential/curvature.hpp"

#include <cstdint>

namespace nephroid {

/// A hit, ready to fill in. Any struct with these member names will do as well; `position` may be left out (it is
/// then origin + distance · direction), and `shading_normal` (it is then the geometric one).
///
/// @tparam C  how the shading normal changes: Flat, ShapeOperator, ParametricCurvature, InterpolatedCurvature,
///            AnyCurvature of several, or your own (differential/curvature.hpp)
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
    V geometric_normal;          ///< unit, of the surface that is really hit; its side says where a ray comes from
    V shading_normal;            ///< unit, on the geometric normal's side; reflection and refraction use this one
    C curvature;                 ///< dn = curvature(dx), for the shading normal as given (the walk flips both)
    scalar_t<V> position_error;  ///< bound on the distance from `position` to the surface, world units, >= 0
    std::size_t surface = 0;     ///< the smooth surface that was hit: an object, not its material or one of
                                 ///< its triangles. Photons that met the same ones are taken for neighbours
                                 ///< (transport/trail.hpp)
    std::uint64_t primitive = 0; ///< what a ray may leave out (transport/contacts.hpp); not needed elsewhere
};

template <class H, class V>
concept HasDistance = requires(const H hit) {
    { hit.distance } -> std::convertible_to<scalar_t<V>>;
};

template <class H, class V>
concept HasGeometricNormal = requires(const H hit) {
    { hit.geometric_normal } -> std::convertible_to<V>;
};

/// If this is what the compiler names: say how the hit's normal changes along the surface. `nephroid::Flat curvature;`
/// is the answer for planes and flat triangles; a curved surface that says so renders a wrong caustic.
template <class H, class V>
concept SaysHowItsNormalChanges = requires(const H hit, const V d_position) {
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
concept Hit = Vector3<V> && HasDistance<H, V> && HasGeometricNormal<H, V> && SaysHowItsNormalChanges<H, V>;

/// The usual bound for `position_error`: a point computed as origin + distance · direction by a careful intersection
/// routine lies this close to the surface. Eight roundings of the largest coordinates that took part.
template <Vector3 V>
[[nodiscard]] scalar_t<V> rounding_error(const V& origin, scalar_t<V> distance, const V& position) {
    using T = scalar_t<V>;
    using t = vector_traits<V>;
    const auto largest = [](const V& v) { return (std::max)({abs(T(t::x(v))), abs(T(t::y(v))), abs(T(t::z(v)))}); };
    return T(8) * std::numeric_limits<T>::epsilon() * (largest(origin) + largest(position) + abs(distance));
}

} // namespace nephroid
