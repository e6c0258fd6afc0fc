// SPDX-License-Identifier: MIT
/// @file  A ray's tangent: the derivative of a photon's position and direction by one emission parameter.
#pragma once

#include "nephroid/vector/algebra.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace nephroid {

/// The derivative of a ray (x, ω) by one parameter p of its emission. Every event along the path acts on each
/// tangent alone, and linearly, so a photon differential is an array of them and a path carries as many as it needs.
///
/// A tangent is scaled by the footprint that its photon stands for (emission/spread.hpp), so `d_position` has the
/// unit of length and `d_direction` is in radians.
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
} // namespace detail

/// What a tangent's components may reach: 2^52 in float, 2^244 in double. Longer than any scene, and so far below the
/// largest number that a flight and a surface do not take it there, nor the fourth power that an ellipse's radii go by
/// (in `wider_t`).
template <Scalar T>
inline constexpr T longest_tangent = detail::power_of_two<T>(
    (std::min)(std::numeric_limits<T>::max_exponent / 2, std::numeric_limits<wider_t<T>>::max_exponent / 4) - 12);

/// Scales a tangent down where it has outgrown that: between curved mirrors tangents grow exponentially, and what
/// overflows ends as NaN. Such a footprint is still far too long, and the excess policy sees it
/// (footprint/policies.hpp).
template <Vector3 V>
void bring_into_range(Tangent<V>& tangent) {
    using T = scalar_t<V>;
    using t = vector_traits<V>;
    const auto sum = [](const V& v) -> T { return abs(T(t::x(v))) + abs(T(t::y(v))) + abs(T(t::z(v))); };
    if (!(sum(tangent.d_position) + sum(tangent.d_direction) > longest_tangent<T>)) // one branch, nearly always taken
        return;
    const T reach = (std::max)(largest_component(tangent.d_position), largest_component(tangent.d_direction));
    if (!(reach > longest_tangent<T>))
        return;
    const T scale = longest_tangent<T> / reach;
    tangent = {scale * tangent.d_position, scale * tangent.d_direction};
}

/// A photon differential: N tangents. Two (u, v) are Frisvad's aligned differential, the common case; further ones
/// (time, wavelength, a second pair for unaligned emission) come after these two.
template <Vector3 V, std::size_t N = 2>
using PhotonDifferential = std::array<Tangent<V>, N>;

} // namespace nephroid
