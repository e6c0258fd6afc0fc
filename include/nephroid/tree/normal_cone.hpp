// SPDX-License-Identifier: MIT
/// @file  A bound on many unit normals, which tests at once whether any or all of them face a direction.
#pragma once

#include "nephroid/tree/box.hpp"

namespace nephroid {

/// Unit normals within a distance of `spread` from `axis`, as points on the unit sphere.
template <Scalar T>
struct NormalCone {
    std::array<T, 3> axis; ///< the middle of the normals, of length 1 at most
    T spread;              ///< distance of the furthest normal from it: 0 if all are the same

    /// Whether normals have a positive inner product with a direction.
    struct Facing {
        bool some; ///< false only if none has
        bool all;  ///< true only if every one has
    };

    /// @param x, y, z  a direction of unit length
    [[nodiscard]] constexpr Facing facing(T x, T y, T z) const {
        const T cosine = x * axis[0] + y * axis[1] + z * axis[2];
        // Normals have unit length, so rounding is of that size. If all are the same, the result is that of each
        // vertex.
        const T reach = spread > T(0) ? spread * (T(1) + rounding) + rounding : T(0);
        return {cosine > -reach, cosine > reach};
    }

private:
    /// Bound of a sum's rounding error over its terms. It is larger than any error seen, and covers compilers that fuse
    /// products and sums.
    static constexpr T rounding = T(64) * std::numeric_limits<T>::epsilon();
};

namespace detail {
/// @param components  the bounds of the normals' components
template <Scalar T>
[[nodiscard]] NormalCone<T> cone_about(const Box<T>& components) {
    NormalCone<T> cone{{}, T(0)};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        cone.axis[axis] = T(0.5) * components.low[axis] + T(0.5) * components.high[axis];
        cone.spread = cone.spread + square(T(0.5) * components.high[axis] - T(0.5) * components.low[axis]);
    }
    cone.spread = sqrt(cone.spread);
    return cone;
}
} // namespace detail

} // namespace nephroid
