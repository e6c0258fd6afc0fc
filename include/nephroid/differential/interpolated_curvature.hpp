// SPDX-License-Identifier: MIT
/// @file  The curvature of a triangle whose shading normal is interpolated from its vertices.
#pragma once

#include "nephroid/vector/algebra.hpp"
#include "nephroid/vector/wide.hpp"

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <optional>

namespace nephroid {

/// A triangle whose shading normal is interpolated from its vertices and normalised: n = N/|N|, N = Σ bᵢ nᵢ, so
/// dn = (I − n nᵀ)(Σ dbᵢ nᵢ)/|N|. Made by `interpolated_normals`.
template <Vector3 V>
struct InterpolatedCurvature {
    V gradient_1, gradient_2; ///< of the barycentric coordinates b1 and b2, 1 / length
    V d_normal_1, d_normal_2; ///< (n1 − n0)/|N| and (n2 − n0)/|N|, normal component removed

    [[nodiscard]] V operator()(const V& d_position) const {
        return dot(gradient_1, d_position) * d_normal_1 + dot(gradient_2, d_position) * d_normal_2;
    }
};

namespace detail {
/// The curvature of a triangle with edges e1, e2 and normals n0, n1, n2; nothing if squares leave the scalar's range.
template <Vector3 V>
[[nodiscard]] std::optional<InterpolatedCurvature<V>>
interpolated_in_range(const V& e1, const V& e2, const V& n0, const V& n1, const V& n2, scalar_t<V> b1, scalar_t<V> b2) {
    using T = scalar_t<V>;
    using W = wider_t<T>;
    // A square below the smallest normal number of T has lost its digits, or the gradients overflow T; above the
    // inverse of that number its inverse has lost them, or the gradients have.
    const T least = (std::numeric_limits<T>::min)(), most = T(1) / least;
    const auto wide_e1 = widened(e1), wide_e2 = widened(e2), face = wide_cross<V>(wide_e1, wide_e2);
    const V d1 = n1 - n0, d2 = n2 - n0;
    const V normal = n0 + (b1 * d1 + b2 * d2);
    const W face2 = wide_dot(face, face);
    const T normal2 = length2(normal);
    if (!(face2 >= W(least) && face2 <= W(most) && normal2 >= least && normal2 <= most))
        return std::nullopt;
    const W inverse_face2 = W(1) / face2;
    const T inverse_normal2 = T(1) / normal2, inverse_length = sqrt(inverse_normal2);
    const auto projected = [&](const V& d) -> V {
        return inverse_length * (d - inverse_normal2 * dot(normal, d) * normal);
    };
    return InterpolatedCurvature<V>{narrowed<V>(inverse_face2, wide_cross<V>(wide_e2, face)),
                                    narrowed<V>(inverse_face2, wide_cross<V>(face, wide_e1)), projected(d1),
                                    projected(d2)};
}

/// The factor that scales the longest of some vectors to about unit length; 0 if all vanish.
template <Vector3 V>
[[nodiscard]] scalar_t<V> to_unit(std::initializer_list<V> vectors) {
    using T = scalar_t<V>;
    T largest(0);
    for (const V& v : vectors)
        largest = (std::max)(largest, largest_component(v));
    return largest >= (std::numeric_limits<T>::min)() ? T(1) / largest : T(0);
}
} // namespace detail

/// The curvature of a triangle with interpolated normals at a hit.
///
/// @param p0,p1,p2  the triangle's vertices
/// @param n0,n1,n2  their normals, unit or not
/// @param b1,b2     barycentric coordinates of the hit: position = p0 + b1 (p1 − p0) + b2 (p2 − p0)
/// @return  zero if the triangle has no area, and so no gradients, or if the interpolated normal vanishes
/// Source: Igehy 1999, "Normal interpolation".
template <Vector3 V>
[[nodiscard]] InterpolatedCurvature<V> interpolated_normals(const V& p0, const V& p1, const V& p2, const V& n0,
                                                            const V& n1, const V& n2, scalar_t<V> b1, scalar_t<V> b2) {
    using T = scalar_t<V>;
    const V e1 = p1 - p0, e2 = p2 - p0;
    if (const auto curvature = detail::interpolated_in_range(e1, e2, n0, n1, n2, b1, b2))
        return *curvature;
    // The same with edges and normals scaled to about unit length: the length of the normals does not matter, and the
    // gradients scale like the inverse of the edges.
    const T s = detail::to_unit({e1, e2}), n = detail::to_unit({n0, n1, n2});
    auto curvature = detail::interpolated_in_range<V>(s * e1, s * e2, n * n0, n * n1, n * n2, b1, b2);
    if (!curvature)
        return {zero_vector<V>(), zero_vector<V>(), zero_vector<V>(), zero_vector<V>()};
    curvature->gradient_1 = s * curvature->gradient_1;
    curvature->gradient_2 = s * curvature->gradient_2;
    return *curvature;
}

} // namespace nephroid
