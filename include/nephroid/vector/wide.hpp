// SPDX-License-Identifier: MIT
/// @file  Vectors in the next wider scalar: float vectors in double, where products of floats are exact.
#pragma once

#include "nephroid/vector/stable.hpp"
#include "nephroid/vector/traits.hpp"

#include <array>
#include <type_traits>

namespace nephroid::detail {

/// A vector's components in `wider_t`: products of floats neither overflow nor vanish in double.
template <Vector3 V>
using Wide3 = std::array<wider_t<scalar_t<V>>, 3>;

template <Vector3 V>
[[nodiscard]] Wide3<V> widened(const V& v) {
    using t = vector_traits<V>;
    using W = wider_t<scalar_t<V>>;
    return {W(t::x(v)), W(t::y(v)), W(t::z(v))};
}

template <class W>
[[nodiscard]] W wide_dot(const std::array<W, 3>& a, const std::array<W, 3>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// a × b. Products of floats are exact in double, so they cancel without an error.
template <Vector3 V>
[[nodiscard]] Wide3<V> wide_cross(const Wide3<V>& a, const Wide3<V>& b) {
    using W = wider_t<scalar_t<V>>;
    const auto difference = [](const W& p, const W& q, const W& r, const W& s) {
        if constexpr (std::is_same_v<W, scalar_t<V>>)
            return difference_of_products<W>(p, q, r, s);
        else
            return p * q - r * s;
    };
    return {difference(a[1], b[2], a[2], b[1]), difference(a[2], b[0], a[0], b[2]), difference(a[0], b[1], a[1], b[0])};
}

/// s a, rounded.
template <Vector3 V>
[[nodiscard]] V narrowed(const wider_t<scalar_t<V>>& s, const Wide3<V>& a) {
    using T = scalar_t<V>;
    return vector_traits<V>::make(T(s * a[0]), T(s * a[1]), T(s * a[2]));
}

} // namespace nephroid::detail
