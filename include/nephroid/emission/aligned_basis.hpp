// SPDX-License-Identifier: MIT
/// @file  Frisvad's aligned bases: with them, two tangents suffice for a light that has an area and emits into a solid
///        angle.
#pragma once

#include "nephroid/vector/frame.hpp"

namespace nephroid {

/// Unit directions of a photon's initial tangents. (u, v) span the emitter's tangent plane, and (theta, phi) the plane
/// perpendicular to the ray. u is parallel to theta, and v to phi once both have reached the first surface. So one
/// tangent carries u and theta, another v and phi, and the footprint is a parallelogram instead of an octagon.
template <Vector3 V>
struct AlignedBasis {
    V u, v;
    V theta, phi;
};

/// @param normal     of the emitter, unit
/// @param direction  of emission, unit, not in the emitter's plane
/// If the two are (nearly) parallel, every basis is aligned, and the one about the direction is used. The footprint
/// does not change at that switch, to rounding.
/// Source: Frisvad et al. 2014, eq. 2 and 3.
template <Vector3 V>
[[nodiscard]] AlignedBasis<V> aligned_basis(const V& normal, const V& direction) {
    using T = scalar_t<V>;
    const V across = cross(normal, direction);
    const T sin2 = length2(across);
    // Below sin² = epsilon any two bases are parallel to rounding.
    const V theta = sin2 > std::numeric_limits<T>::epsilon() ? V(T(1) / sqrt(sin2) * across) : frame_about(direction).u;
    const V u = normalize(V(theta - dot(theta, normal) * normal));
    return {u, cross(u, normal), theta, cross(theta, direction)};
}

} // namespace nephroid
