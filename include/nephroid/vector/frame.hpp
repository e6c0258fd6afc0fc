// SPDX-License-Identifier: MIT
/// @file  Orthonormal frames about a unit vector.
#pragma once

#include "nephroid/vector/algebra.hpp"

namespace nephroid {

/// Two unit vectors that complete a unit vector n to a right-handed orthonormal frame: u × v = n.
template <Vector3 V>
struct Frame {
    V u;
    V v;
};

/// Makes a frame about any unit vector n, without a singularity, a loss of digits or a normalisation. It is continuous
/// but where n.z changes sign. |n| must be 1 to rounding (not checked).
/// Source: Duff et al. 2017, "Building an Orthonormal Basis, Revisited", which corrects Frisvad 2012 near (0, 0, −1).
template <Vector3 V>
[[nodiscard]] Frame<V> frame_about(const V& n) {
    using T = scalar_t<V>;
    using t = vector_traits<V>;
    const T x = t::x(n), y = t::y(n), z = t::z(n);
    const T sign = z < T(0) ? T(-1) : T(1);
    const T a = T(-1) / (sign + z);
    const T b = x * y * a;
    return {t::make(T(1) + sign * x * x * a, sign * b, -sign * x), t::make(b, sign + y * y * a, -y)};
}

} // namespace nephroid
