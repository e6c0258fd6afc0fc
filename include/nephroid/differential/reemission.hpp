// SPDX-License-Identifier: MIT
/// @file  Diffuse re-emission: fresh tangents whose footprint starts at the size that arrived.
#pragma once

#include "nephroid/differential/tangent.hpp"
#include "nephroid/vector/frame.hpp"

namespace nephroid {

/// The differential of a photon that a diffuse surface re-emits in a random direction.
///
/// The new direction does not depend on the emission parameters, so the old tangents end here. The new ones start as if
/// the photon had flown a virtual distance v from a point, chosen such that the footprint keeps its area |∂x_u ×
/// ∂x_v|.
/// `d_position` already includes the virtual flight.
///
/// @param arrived             the differential at the surface; its first two tangents span the footprint
/// @param direction           of the re-emitted ray, unit
/// @param d_direction_length  |∂ω/∂p| of each new tangent, radians, > 0: `Spread::length(solid angle)` of the
///                            directions the bounce chose from (emission/spread.hpp)
/// Source: De Barro et al. 2025 (ARP), eq. 2, after Fabianowski and Dingliana 2009.
template <Vector3 V, std::size_t N>
    requires(N >= 2)
[[nodiscard]] PhotonDifferential<V, 2> reemit(const PhotonDifferential<V, N>& arrived, const V& direction,
                                              scalar_t<V> d_direction_length) {
    using T = scalar_t<V>;
    const T arrived_area = length(cross(arrived[0].d_position, arrived[1].d_position));
    const T virtual_distance = sqrt(arrived_area) / d_direction_length;
    const Frame<V> frame = frame_about(direction);
    const V d_theta = d_direction_length * frame.u;
    const V d_phi = d_direction_length * frame.v;
    return {Tangent<V>{virtual_distance * d_theta, d_theta}, Tangent<V>{virtual_distance * d_phi, d_phi}};
}

} // namespace nephroid
