// SPDX-License-Identifier: MIT
/// @file  Frisvad's aligned bases, with which two tangents suffice for a light with both an area and a solid angle.
#pragma once

#include "nephroid/vector/frame.hpp"

namespace nephroid {

/// Unit directions of a photon's initial tangents. (u, v) span the emitter's tangent plane, (theta, phi) the plane
/// across the ray; u ∥ theta, and v ∥ phi once both have reached the first surface, so that one tangent carries
/// u and theta and another v and phi, and their footprint is a parallelogram instead of an octagon.
template <Vector3 V>
struct AlignedBasis {
    V u, v;
    V theta, phi;
};

/// @param normal     of the emitter, unit
/// @param direction  of emission, unit, not in the emitter's plane
/// Where the two are (nearly) parallel every basis is aligned; it is then built about the direction. The footprint
/// is the same to rounding on both sides of that switch.
/// Source: Frisvad et al. 2014, eq. 2 and 3.
template <Vector3 V>
[[nodiscard]] AlignedBasis<V> aligned_basis(const V& normal, const V& direction) {
    using T = scalar_t<V>;
    const V across = cross(normal, direction);
    const T sin2 = length2(across);
    // Below sin² = epsilon the bases are parallel to rounding whichever way they are turned.
    const V theta = sin2 > std::numeric_limits<T>::epsilon() ? V(T(1) / sqrt(sin2) * across) : frame_about(direction).u;
    const V u = normalize(V(theta - dot(theta, normal) * normal));
    return {u, cross(u, normal), theta, cross(theta, direction)};
}

} // namespace nephroid
