// SPDX-License-Identifier: MIT
/// @file  The concept of a scalar, and the mathematical functions that the library calls on scalars.
#pragma once

#include "nephroid/vector/bits.hpp"
#include "nephroid/vector/language.hpp"

#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <numbers>
#include <type_traits>

namespace nephroid {

/// Whether a type is a scalar. Specialise it to true for one that is not a built-in floating-point type (a dual number,
/// a wider float). The type needs + − * /, comparisons, construction from arithmetic types and explicit conversion to
/// them, std::numeric_limits, and sqrt, abs, sin, cos, isfinite found by argument-dependent look-up (atan2 where
/// footprints are bounded, exp for the Gaussian kernel). Comparisons decide which way a photon goes. vector/dual.hpp is
/// such a scalar.
template <class T>
inline constexpr bool is_scalar = std::is_floating_point_v<T>;

template <class T>
concept Scalar = is_scalar<T>;

template <Scalar T>
inline constexpr T pi = T(3.141592653589793238462643383279502884197L); // libc++ 14 has it in double precision only

template <>
inline constexpr float pi<float> = std::numbers::pi_v<float>;

template <>
inline constexpr double pi<double> = std::numbers::pi_v<double>;

/// The type in which squares of T are compared or summed: double for float, because squares may leave its range; else
/// T.
template <Scalar T>
using wider_t = std::conditional_t<std::is_same_v<T, float>, double, T>;

/// x²
template <class T>
[[nodiscard]] constexpr T square(const T& x) {
    return x * x;
}

// Unqualified calls inside the library find these for built-in types and the user's own by argument-dependent look-up.
using std::abs;
using std::cos;
using std::sin;
using std::sqrt;

/// Whether x is neither infinite nor NaN, by the bits of the exponent: -ffast-math makes std::isfinite always true.
[[nodiscard]] constexpr bool isfinite(float x) { return (~detail::bit_cast<std::uint32_t>(x) & 0x7f800000u) != 0; }
[[nodiscard]] constexpr bool isfinite(double x) {
    return (~detail::bit_cast<std::uint64_t>(x) & 0x7ff0000000000000u) != 0;
}
[[nodiscard]] inline bool isfinite(long double x) { return std::isfinite(x); }

} // namespace nephroid
