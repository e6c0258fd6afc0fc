// SPDX-License-Identifier: MIT
/// @file  Gives a deposit its second-order footprint, and shifts it so that its bias cancels.
///
/// A splat of shape S (smoothing_rule.hpp) at the photon's landing point F is shifted by
///
///     D = m₂/2 (S_ab F_ab + (∂_a S_ab) F_b).
///
/// This leaves a bias of fourth order and costs nothing per pixel [include/nephroid/README.md, "The second-order
/// shift"].
#pragma once

#include "nephroid/smoothing/second_order/emission_cells.hpp"
#include "nephroid/smoothing/second_order/field_options.hpp"
#include "nephroid/smoothing/second_order/path_derivatives.hpp"
#include "nephroid/transport/deposit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace nephroid::detail {

/// The part of a vector in the tangent plane.
template <Vector3 V>
[[nodiscard]] Double3 along_surface(const Double3& v, const V& normal) {
    const Double3 n = double3(normal);
    return v - inner(v, n) * n;
}

template <Vector3 V, Flux F, std::size_t N>
void scale_tangents(Deposit<V, F, N>& deposit, scalar_t<V> factor) {
    for (V& d : deposit.d_position)
        d = factor * d;
}

/// Bounds of a shift.
struct ShiftLimits {
    double largest_shift; ///< over the longer of the new half tangents
    double largest_reach; ///< of the half tangents, world units: longer ones count as this long
};

/// Gives a deposit the footprint that a field chose, and shifts it.
///
/// @param deposit        of a photon that was emitted with smoothing 1
/// @param found          by the field; its shape must be positive definite
/// @param second_moment  of the kernel, m₂
/// @param second         if not null, gets the map's second derivatives by the new half tangents, along the surface,
///                       shortened by the same factor as the shift
/// @return  whether the shift was shortened
template <Vector3 V, Flux F, std::size_t N>
bool shift_deposit(Deposit<V, F, N>& deposit, const FieldSample& found, double second_moment, const ShiftLimits& limits,
                   std::array<Double3, 3>* second) {
    using T = scalar_t<V>;
    const auto tangents = half_tangents(deposit);
    const double factor = 0.5 * second_moment;
    const Symmetric2& s = found.shape;
    Plane2 drift = factor * found.divergence; // the part of the shift due to footprints that change
    // It is limited to a quarter of the footprint's radius along it.
    const double size2 =
        (s.yy * drift.x * drift.x - 2 * s.xy * drift.x * drift.y + s.xx * drift.y * drift.y) / s.determinant();
    bool bounded = size2 > 1.0 / 16;
    if (bounded)
        drift = (0.25 / std::sqrt(size2)) * drift;
    // The part of the shift due to the bending map.
    const Double3 bend = along_surface(
        factor * (s.xx * found.second[0] + ((2 * s.xy) * found.second[1] + s.yy * found.second[2])), deposit.normal);

    // With S = L Lᵀ, the new tangents are J L.
    const double l00 = std::sqrt(s.xx), l10 = s.xy / l00, l11 = std::sqrt(s.determinant()) / l00;
    const Double3 a = l00 * tangents[0] + l10 * tangents[1], b = l11 * tangents[1];
    const double reach = (std::min)(std::sqrt((std::max)(inner(a, a), inner(b, b))), limits.largest_reach);
    const double longest = limits.largest_shift * reach;
    const Double3 shift = bend + (drift.x * tangents[0] + drift.y * tangents[1]);
    const double distance = std::sqrt(inner(shift, shift));
    const double kept = distance > longest ? longest / distance : 1;
    bounded = bounded || distance > longest;
    if (second != nullptr) {
        *second = rotated(found.second, {{l00, l10}, {0, l11}});
        for (Double3& h : *second)
            h = along_surface(kept * h, deposit.normal);
    }

    // From here on in the renderer's own scalar, which may be a dual number: S and H are constants to it.
    const V d_u = deposit.d_position[0], d_v = deposit.d_position[1];
    scale_tangents(deposit, T(std::sqrt(std::sqrt(s.determinant())))); // for tangents beyond the first two
    deposit.d_position[0] = T(l00) * d_u + T(l10) * d_v;
    deposit.d_position[1] = T(l11) * d_v;
    deposit.position =
        deposit.position + (T(0.5 * kept * drift.x) * d_u + T(0.5 * kept * drift.y) * d_v) + to_world<V>(kept * bend);
    return bounded;
}

} // namespace nephroid::detail
