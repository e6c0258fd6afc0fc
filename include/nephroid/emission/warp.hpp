// SPDX-License-Identifier: MIT
/// @file  Area-preserving maps of low distortion from the unit square to disks, triangles and sets of directions.
///
/// They keep the stratification of a sample sequence: they are continuous, map equal areas of the square to equal areas
/// (projected areas for the cosine-weighted hemisphere), and keep neighbours together. Arguments u1, u2 are in [0, 1].
#pragma once

#include "nephroid/vector/frame.hpp"

#include <algorithm>

namespace nephroid {

/// A point of the unit disk: x² + y² <= 1 to rounding.
template <Scalar T>
struct DiskPoint {
    T x;
    T y;
};

/// Maps the square to the disk; concentric squares become concentric circles.
/// Source: Shirley and Chiu 1997, "A low distortion map between disk and square".
template <Scalar T>
[[nodiscard]] DiskPoint<T> concentric_disk(T u1, T u2) {
    const T a = T(2) * u1 - T(1), b = T(2) * u2 - T(1);
    if (a == T(0) && b == T(0))
        return {T(0), T(0)};
    if (abs(a) > abs(b)) {
        const T angle = pi<T> / T(4) * (b / a);
        return {a * cos(angle), a * sin(angle)};
    }
    const T angle = pi<T> / T(4) * (a / b);
    return {b * sin(angle), b * cos(angle)};
}

/// Maps the disk to a cap of the unit sphere, so that directions are uniform; the disk's radius becomes the distance
/// from the axis.
///
/// @param axis    of the cap, unit
/// @param frame   about the axis
/// @param height  of the cap, 1 − cos(its half angle), in [0, 2]: its solid angle is 2π height. The cosine itself
///                is not computed, so that narrow cones lose no digits
/// Source: Lambert's azimuthal projection.
template <Vector3 V>
[[nodiscard]] V cap_direction(const V& axis, const Frame<V>& frame, scalar_t<V> height,
                              const DiskPoint<scalar_t<V>>& disk) {
    using T = scalar_t<V>;
    const T depth = height * (std::min)(T(1), disk.x * disk.x + disk.y * disk.y); // 1 − cos(angle from the axis)
    const T stretch = sqrt(height * (T(2) - depth));
    return (stretch * disk.x) * frame.u + ((stretch * disk.y) * frame.v + (T(1) - depth) * axis);
}

/// Maps the disk to the hemisphere about the axis with density cos/π per steradian, by projecting it up to the sphere.
///
/// @param axis   unit
/// @param frame  about the axis
/// @return  unit to rounding. Its cosine with the axis is at least sqrt(epsilon), the resolution of a disk point, so
///          that the inverse of the density is finite
/// Source: Malley's method; see Pharr, Jakob, Humphreys, "Physically Based Rendering".
template <Vector3 V>
[[nodiscard]] V cosine_direction(const V& axis, const Frame<V>& frame, const DiskPoint<scalar_t<V>>& disk) {
    using T = scalar_t<V>;
    const T cosine2 = T(1) - (disk.x * disk.x + disk.y * disk.y);
    const T cosine = sqrt((std::max)(std::numeric_limits<T>::epsilon(), cosine2));
    return disk.x * frame.u + (disk.y * frame.v + cosine * axis);
}

/// A point of a triangle: p0 + b1 (p1 − p0) + b2 (p2 − p0), with b1, b2 and 1 − b1 − b2 in [0, 1].
template <Scalar T>
struct Barycentrics {
    T b1;
    T b2;
};

/// Maps the square to a triangle by two affine maps, one on each side of the diagonal, which becomes the median from
/// p0.
/// Source: Heitz 2019, "A low-distortion map between triangle and square".
template <Scalar T>
[[nodiscard]] Barycentrics<T> triangle_point(T u1, T u2) {
    if (u2 > u1) {
        const T half = T(0.5) * u1;
        return {half, u2 - half};
    }
    const T half = T(0.5) * u2;
    return {u1 - half, half};
}

} // namespace nephroid
