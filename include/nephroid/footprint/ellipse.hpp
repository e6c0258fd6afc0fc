// SPDX-License-Identifier: MIT
/// @file  A photon's footprint: an ellipse in the tangent plane of the surface it lands on.
#pragma once

#include "nephroid/vector/frame.hpp"
#include "nephroid/vector/wide.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace nephroid {

/// An ellipse about the origin: the points cos φ · a + sin φ · b. The semi-axis vectors need not be orthogonal.
template <Vector3 V>
struct Ellipse {
    V a, b;
    V normal; ///< unit, of the plane that a and b lie in
};

/// The footprint of a photon differential: semi-axes ½ D_u x and ½ D_v x.
/// Source: Frisvad et al. 2014, section 3.1 and figure 4.
template <Vector3 V>
[[nodiscard]] Ellipse<V> footprint(const V& d_position_u, const V& d_position_v, const V& normal) {
    return {scalar_t<V>(0.5) * d_position_u, scalar_t<V>(0.5) * d_position_v, normal};
}

namespace detail {
/// n · (a × b)
template <Vector3 V>
[[nodiscard]] wider_t<scalar_t<V>> wide_area(const V& a, const V& b, const V& normal) {
    return wide_dot(widened(normal), wide_cross<V>(widened(a), widened(b)));
}
} // namespace detail

/// Signed |a × b|: the ellipse's area over that of the unit disk, world units squared.
template <Vector3 V>
[[nodiscard]] scalar_t<V> area_scale(const Ellipse<V>& ellipse) {
    return scalar_t<V>(detail::wide_area(ellipse.a, ellipse.b, ellipse.normal));
}

/// The ellipse's area A_p = π |a × b| [Frisvad et al. 2014, eq. 4].
template <Vector3 V>
[[nodiscard]] scalar_t<V> area(const Ellipse<V>& ellipse) {
    return pi<scalar_t<V>> * abs(area_scale(ellipse));
}

/// The exact semi-axes' lengths: the singular values of [a b]. The longer of |a| and |b|, which Frisvad et al. take
/// for the major radius, is up to √2 too short when the two are not orthogonal.
template <Vector3 V>
[[nodiscard]] SingularValues<scalar_t<V>> radii(const Ellipse<V>& ellipse) {
    using T = scalar_t<V>;
    using W = wider_t<T>;
    const auto a = detail::widened(ellipse.a), b = detail::widened(ellipse.b);
    const W aa = detail::wide_dot(a, a), bb = detail::wide_dot(b, b), ab = detail::wide_dot(a, b);
    const W major = sqrt(W(0.5) * (aa + bb + sqrt(square(aa - bb) + square(W(2) * ab))));
    if (!(major > W(0)))
        return {T(0), T(0)};
    const W area = abs(detail::wide_area(ellipse.a, ellipse.b, ellipse.normal));
    return {T(major), T((std::min)(major, area / major))};
}

/// Half the extents of the tight axis-aligned box: sqrt(aᵢ² + bᵢ²) along axis i.
template <Vector3 V>
[[nodiscard]] V half_extents(const Ellipse<V>& ellipse) {
    using T = scalar_t<V>;
    using t = vector_traits<V>;
    const auto along = [](T a, T b) { return sqrt(a * a + b * b); };
    return t::make(along(t::x(ellipse.a), t::x(ellipse.b)), along(t::y(ellipse.a), t::y(ellipse.b)),
                   along(t::z(ellipse.a), t::z(ellipse.b)));
}

/// Two rows of a matrix M that takes the ellipse to the unit circle: |M x| < 1 inside it.
template <Vector3 V>
struct FilterMatrix {
    V row_a, row_b;
};

/// M for semi-axes a and b: the top rows of the inverse of [a b n], without inverting a 3 × 3 matrix: b × n and n ×
/// a, over a · (b × n).
///
/// Plain products suffice: a and b are perpendicular to n, so nothing cancels in the rows' lengths. Cancellation in the
/// determinant costs no more than the rounding of the rows themselves, a few epsilon times |a| |b| / |a × b|.
/// The ellipse must not have collapsed: |a × b| > 0; |a| |b| must be in the scalar's range (neither is checked).
/// Source: Frisvad et al. 2014, eq. 12.
template <Vector3 V>
[[nodiscard]] FilterMatrix<V> filter_matrix(const Ellipse<V>& ellipse) {
    using t = vector_traits<V>;
    using T = scalar_t<V>;
    const T ax = t::x(ellipse.a), ay = t::y(ellipse.a), az = t::z(ellipse.a);
    const T bx = t::x(ellipse.b), by = t::y(ellipse.b), bz = t::z(ellipse.b);
    const T nx = t::x(ellipse.normal), ny = t::y(ellipse.normal), nz = t::z(ellipse.normal);
    const T x = by * nz - bz * ny, y = bz * nx - bx * nz, z = bx * ny - by * nx;
    const T inverse = T(1) / (ax * x + ay * y + az * z);
    return {t::make(inverse * x, inverse * y, inverse * z),
            t::make(inverse * (ny * az - nz * ay), inverse * (nz * ax - nx * az), inverse * (nx * ay - ny * ax))};
}

/// The ratio of the minor to the major radius, σ_min/σ_max, in [0, 1]; 1 is a circle, and so is a point.
template <Vector3 V>
[[nodiscard]] scalar_t<V> axis_ratio(const Ellipse<V>& ellipse) {
    const auto sigma = radii(ellipse);
    return sigma.major > scalar_t<V>(0) ? sigma.minor / sigma.major : scalar_t<V>(1);
}

namespace detail {
/// The frame in which an ellipse's covariance is computed: unit vectors along the longest of the vectors that span it,
/// and across.
template <Vector3 V>
[[nodiscard]] Frame<V> frame_along(const V& longest, const V& normal) {
    using t = vector_traits<V>;
    using T = scalar_t<V>;
    const bool vanishes = !(abs(T(t::x(longest))) + abs(T(t::y(longest))) + abs(T(t::z(longest))) > T(0));
    const V u = vanishes ? frame_about(normal).u : direction_of(longest);
    return {u, cross(normal, u)};
}

/// The ellipse with a given covariance in a frame: the covariance's Cholesky factor. The determinant is given instead
/// of the variance along v, because the factor would have to be computed from that by a difference.
template <Vector3 V>
[[nodiscard]] Ellipse<V> ellipse_of_covariance(const Frame<V>& frame, const V& normal, wider_t<scalar_t<V>> variance_u,
                                               wider_t<scalar_t<V>> covariance, wider_t<scalar_t<V>> determinant) {
    using T = scalar_t<V>;
    using W = wider_t<T>;
    if (variance_u == W(0))
        return {zero_vector<V>(), zero_vector<V>(), normal};
    const W deviation = sqrt(variance_u);
    return {T(deviation) * frame.u + T(covariance / deviation) * frame.v, T(sqrt(determinant) / deviation) * frame.v,
            normal};
}
} // namespace detail

/// The ellipse with covariance a aᵀ + b bᵀ + r² (I − n nᵀ): a disk of radius r added in quadrature, as a
/// convolution adds second moments. It is continuous through collapse: a point becomes the disk. r = 0 changes only the
/// choice of axis vectors.
template <Vector3 V>
[[nodiscard]] Ellipse<V> add_disk(const Ellipse<V>& ellipse, scalar_t<V> radius) {
    using T = scalar_t<V>;
    using W = wider_t<T>;
    const auto a = detail::widened(ellipse.a), b = detail::widened(ellipse.b), n = detail::widened(ellipse.normal);
    const W aa = detail::wide_dot(a, a), bb = detail::wide_dot(b, b), ab = detail::wide_dot(a, b);
    const bool along_a = aa >= bb;
    const auto& longer = along_a ? a : b;
    const W longer2 = along_a ? aa : bb;
    if (longer2 < (std::numeric_limits<W>::min)()) { // a point: its squares underflow
        const Frame<V> frame = frame_about(ellipse.normal);
        return {radius * frame.u, radius * frame.v, ellipse.normal};
    }
    // Along the longer vector l, the other one's component is their inner product over |l|; across it, their area over
    // |l|.
    const W area = detail::wide_dot(n, detail::wide_cross<V>(a, b)), radius2 = square(W(radius));
    const W inverse2 = W(1) / longer2;
    const W variance = longer2 + ab * ab * inverse2 + radius2, covariance = (along_a ? ab : -ab) * area * inverse2;
    // det(A Aᵀ + r² I) = det(A)² + r² |A|² + r⁴: a sum of squares, so nothing cancels.
    const W determinant = square(area) + radius2 * (aa + bb) + square(radius2);
    // The covariance's Cholesky factor, for l and n × l instead of unit vectors.
    const W scale = W(1) / (sqrt(variance) * sqrt(longer2));
    const W along = variance * scale, across = covariance * scale, shorter = sqrt(determinant) * scale;
    const auto side = detail::wide_cross<V>(n, longer);
    const auto sum = [&](std::size_t axis) { return T(along * longer[axis] + across * side[axis]); };
    const auto other = [&](std::size_t axis) { return T(shorter * side[axis]); };
    return {make_vector<V>(sum(0), sum(1), sum(2)), make_vector<V>(other(0), other(1), other(2)), ellipse.normal};
}

/// The ellipse of any number of tangents' displacements: their covariances add up. Two tangents give exactly
/// `footprint`. A third one (time, wavelength) stretches the ellipse along its displacement. Four come from an
/// unaligned emission, whose octagon [Suykens and Willems 2001] is replaced by the ellipse with the same second
/// moments.
template <Vector3 V, std::size_t N>
    requires(N >= 2)
[[nodiscard]] Ellipse<V> footprint(const std::array<V, N>& d_position, const V& normal) {
    if constexpr (N == 2) {
        return footprint(d_position[0], d_position[1], normal);
    } else {
        using W = wider_t<scalar_t<V>>;
        const auto shorter = [](const V& a, const V& b) { return length2(a) < length2(b); };
        const Frame<V> frame =
            detail::frame_along(*std::max_element(d_position.begin(), d_position.end(), shorter), normal);
        const auto along = detail::widened(frame.u), across = detail::widened(frame.v);
        W variance_u(0), covariance(0), determinant(0);
        for (std::size_t i = 0; i < N; ++i) {
            const auto d = detail::widened(d_position[i]);
            const W u = W(0.5) * detail::wide_dot(d, along), v = W(0.5) * detail::wide_dot(d, across);
            variance_u = variance_u + u * u;
            covariance = covariance + u * v;
            // By the Cauchy-Binet formula the determinant is the sum of all pairs' squared areas.
            for (std::size_t j = 0; j < i; ++j)
                determinant = determinant + square(W(0.25) * detail::wide_area(d_position[i], d_position[j], normal));
        }
        return detail::ellipse_of_covariance(frame, normal, variance_u, covariance, determinant);
    }
}

} // namespace nephroid
