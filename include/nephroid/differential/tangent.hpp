// SPDX-License-Identifier: MIT
/// @file  A ray's tangent: the derivative of a photon's position and direction by one emission parameter.
#pragma once

#include "nephroid/vector/algebra.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace nephroid {

/// The derivative of a ray (x, ω) by one parameter p of its emission. Every event along the path acts on each tangent
/// separately and linearly, so a photon differential is an array of tangents, as many as a path needs.
///
/// A tangent is scaled to the photon's footprint (emission/spread.hpp): `d_position` is in world units, `d_direction`
/// in radians.
template <Vector3 V>
struct Tangent {
    V d_position;  ///< ∂x/∂p
    V d_direction; ///< ∂ω/∂p, orthogonal to ω
};

namespace detail {
template <Scalar T>
[[nodiscard]] constexpr T power_of_two(int exponent) {
    T power(1);
    for (; exponent > 0; --exponent)
        power = T(2) * power;
    return power;
}

/// The largest component that a tangent may have: 2^52 in float, 2^244 in double. It is larger than any scene, and
/// small enough that neither a flight, nor a surface, nor the fourth powers behind an ellipse's radii (in `wider_t`)
/// overflow.
template <Scalar T>
inline constexpr T longest_tangent = power_of_two<T>((std::min)(std::numeric_limits<T>::max_exponent / 2,
                                                                std::numeric_limits<wider_t<T>>::max_exponent / 4) -
                                                     12);

/// Scales a tangent down to `longest_tangent` where it is longer. Between curved mirrors tangents grow exponentially,
/// and would overflow to NaN. Such a footprint stays far too long, so the excess policy acts on it
/// (footprint/policies.hpp).
template <Vector3 V>
void bring_into_range(Tangent<V>& tangent) {
    using T = scalar_t<V>;
    using t = vector_traits<V>;
    const auto sum = [](const V& v) -> T { return abs(T(t::x(v))) + abs(T(t::y(v))) + abs(T(t::z(v))); };
    if (!(sum(tangent.d_position) + sum(tangent.d_direction) > longest_tangent<T>)) // nearly always
        return;
    const T reach = (std::max)(largest_component(tangent.d_position), largest_component(tangent.d_direction));
    if (!(reach > longest_tangent<T>))
        return;
    const T scale = longest_tangent<T> / reach;
    tangent = {scale * tangent.d_position, scale * tangent.d_direction};
}
} // namespace detail

/// A photon differential: N tangents. The first two (u, v) are Frisvad's aligned differential, the common case; others
/// (time, wavelength, a second pair for unaligned emission) follow them.
template <Vector3 V, std::size_t N = 2>
using PhotonDifferential = std::array<Tangent<V>, N>;

} // namespace nephroid
