// SPDX-License-Identifier: MIT
/// @file  Diffuse re-emission: fresh tangents whose footprint starts at the size that arrived.
#pragma once

#include "nephroid/differential/tangent.hpp"
#include "nephroid/vector/frame.hpp"

namespace nephroid {

/// The differential of a photon that a diffuse surface re-emits in a random direction.
///
/// The new direction does not depend on the emission parameters, so the old tangents end here. The new ones start as if
/// the photon had flown a virtual distance v from a point, chosen such that the footprint keeps its area on the
/// surface: across the new direction it is |(∂x_u × ∂x_v) · ω|. `d_position` already includes the virtual
/// flight.
///
/// @param arrived             the differential at the surface; its first two tangents span the footprint, in the
///                            surface's plane
/// @param direction           of the re-emitted ray, unit
/// @param d_direction_length  |∂ω/∂p| of each new tangent, radians, > 0: `Spread::length(1 / density)` of the
///                            bounce's own density, which is cos/π for a diffuse surface (emission/spread.hpp), and
///                            not that of the light: a collimated beam has none
/// Source: De Barro et al. 2025 (ARP), eq. 2, after Fabianowski and Dingliana 2009. There the area is |∂x_u ×
/// ∂x_v| also across the direction, which transfer to the surface then divides by the cosine, and the length is the
/// light's.
template <Vector3 V, std::size_t N>
    requires(N >= 2)
[[nodiscard]] PhotonDifferential<V, 2> reemit(const PhotonDifferential<V, N>& arrived, const V& direction,
                                              scalar_t<V> d_direction_length) {
    using T = scalar_t<V>;
    const T area_across = abs(dot(cross(arrived[0].d_position, arrived[1].d_position), direction));
    const T virtual_distance = sqrt(area_across) / d_direction_length;
    const Frame<V> frame = frame_about(direction);
    const V d_theta = d_direction_length * frame.u;
    const V d_phi = d_direction_length * frame.v;
    return {Tangent<V>{virtual_distance * d_theta, d_theta}, Tangent<V>{virtual_distance * d_phi, d_phi}};
}

} // namespace nephroid
