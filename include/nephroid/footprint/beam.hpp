// SPDX-License-Identifier: MIT
/// @file  A beam: a photon's footprint at any depth of its flight, in the plane across it.
///
/// Tangents change linearly along a flight, P(t) = (∂x)⊥ + t ∂ω, so the footprint at depth t is an ellipse with
/// the semi-axes ½ P_u(t) and ½ P_v(t), wherever a surface may be. include/nephroid/README.md, "Beams", derives it.
#pragma once

#include "nephroid/differential/tangent.hpp"
#include "nephroid/footprint/ellipse.hpp"

#include <array>
#include <cstddef>

namespace nephroid {

/// A beam about a ray. Its semi-axes at depth t are start[i] + t growth[i], as coordinates in the frame across the ray.
template <Vector3 V>
struct Beam {
    using T = scalar_t<V>;
    using Pair = std::array<T, 2>;

    V origin;                  ///< of the ray; in any frame of reference
    V direction;               ///< unit
    Frame<V> frame;            ///< across it
    std::array<Pair, 2> start; ///< of u and v: along frame.u and frame.v, world units
    std::array<Pair, 2> growth;
    T filter2; ///< squared radius of a disk that is added to each footprint, >= 0

    /// A footprint's matrix, as `radius2` and `scale` need it.
    struct At {
        T ux, uy, vx, vy, determinant; ///< D = det C, world units to the fourth
    };
    [[nodiscard]] At at(T t) const {
        const T ux = start[0][0] + t * growth[0][0], uy = start[0][1] + t * growth[0][1];
        const T vx = start[1][0] + t * growth[1][0], vy = start[1][1] + t * growth[1][1];
        const T area = ux * vy - uy * vx;
        return {ux, uy, vx, vy, area * area + filter2 * (ux * ux + uy * uy + vx * vx + vy * vy) + filter2 * filter2};
    }

    /// The squared radius in a footprint, 1 on its outline: qᵀ C⁻¹ q for C = A Aᵀ + filter2 I. All terms
    /// are squares, so nothing cancels. A focus needs no case of its own, unless both it and the filter are
    /// points: NaN or infinite.
    ///
    /// @param x, y  along frame.u and frame.v
    [[nodiscard]] T radius2(const At& a, T x, T y) const {
        const T qu = x * a.uy - y * a.ux, qv = x * a.vy - y * a.vx;
        return (qu * qu + qv * qv + filter2 * (x * x + y * y)) / a.determinant;
    }

    /// The largest radius of the footprint at a depth. As the semi-axes are linear in t and a norm is convex, it lies
    /// nowhere between two depths above the line through its values there.
    [[nodiscard]] T largest_radius(T t) const {
        using W = wider_t<T>;
        const At a = at(t);
        const W uu = W(a.ux) * W(a.ux) + W(a.uy) * W(a.uy), vv = W(a.vx) * W(a.vx) + W(a.vy) * W(a.vy),
                uv = W(a.ux) * W(a.vx) + W(a.uy) * W(a.vy);
        return T(sqrt(W(0.5) * (uu + vv + sqrt(square(uu - vv) + square(W(2) * uv))) + W(filter2)));
    }
};

namespace detail {
template <Vector3 V>
[[nodiscard]] typename Beam<V>::Pair half_across(const Frame<V>& frame, const V& v) {
    using T = scalar_t<V>;
    return {T(0.5) * dot(v, frame.u), T(0.5) * dot(v, frame.v)};
}
} // namespace detail

/// The beam of a photon's first two tangents.
///
/// @param tangents       at the origin
/// @param scale          factor of the tangents, such as a smoothing, > 0
/// @param filter_radius  world units, >= 0
template <Vector3 V, std::size_t N>
    requires(N >= 2)
[[nodiscard]] Beam<V> beam_of(const V& origin, const V& direction, const PhotonDifferential<V, N>& tangents,
                              scalar_t<V> scale = scalar_t<V>(1), scalar_t<V> filter_radius = scalar_t<V>(0)) {
    Beam<V> beam{origin, direction, frame_about(direction), {}, {}, filter_radius * filter_radius};
    for (std::size_t i = 0; i < 2; ++i) {
        beam.start[i] = detail::half_across(beam.frame, V(scale * tangents[i].d_position));
        beam.growth[i] = detail::half_across(beam.frame, V(scale * tangents[i].d_direction));
    }
    return beam;
}

/// A round beam, of the radius r0 + r1 t at depth t [Herzog et al. 2007].
template <Vector3 V>
[[nodiscard]] Beam<V> cone_beam(const V& origin, const V& direction, scalar_t<V> r0, scalar_t<V> r1) {
    using T = scalar_t<V>;
    return {origin, direction, frame_about(direction), {{{r0, T(0)}, {T(0), r0}}}, {{{r1, T(0)}, {T(0), r1}}}, T(0)};
}

} // namespace nephroid
