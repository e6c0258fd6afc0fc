// SPDX-License-Identifier: MIT
/// @file  A bound on many unit normals: one test tells whether any of them, or all, face a direction.
#pragma once

#include "nephroid/tree/box.hpp"

namespace nephroid {

/// Unit normals that lie within `spread` of `axis`, as places on the unit sphere.
template <Scalar T>
struct NormalCone {
    std::array<T, 3> axis; ///< the middle of the normals, of length 1 at most
    T spread;              ///< how far the furthest of them is from it: 0 where all are the same

    /// How many of the normals have a positive product with a direction.
    struct Facing {
        bool some; ///< false only if none has
        bool all;  ///< true only if every one has
    };

    /// @param x, y, z  a direction of unit length
    [[nodiscard]] constexpr Facing facing(T x, T y, T z) const {
        const T cosine = x * axis[0] + y * axis[1] + z * axis[2];
        // Normals are of unit length, so rounding is of that size; where all are the same they give what a vertex does.
        const T reach = spread > T(0) ? spread * (T(1) + rounding) + rounding : T(0);
        return {cosine > -reach, cosine > reach};
    }

private:
    /// Of a sum's terms: more than was ever seen, for compilers that fuse products and sums.
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
