// SPDX-License-Identifier: MIT
/// @file  What a scalar is, and the mathematical functions that the library calls on one.
#pragma once

#include "nephroid/version.hpp"

#include <bit>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <numbers>
#include <type_traits>

namespace nephroid {

/// Opens the library to a scalar that is not a built-in floating-point type (a dual number, a wider float).
/// Specialise to true; the type then needs + − * /, comparisons, construction from arithmetic types and explicit
/// conversion to them, std::numeric_limits, and sqrt, abs, sin, cos, isfinite found by argument-dependent look-up
/// (atan2 where footprints are bounded, exp for the Gaussian kernel). Comparisons decide which way a photon goes; a
/// dual number compares its value alone. vector/dual.hpp is one, through which a whole caustic is differentiated.
template <class T>
inline constexpr bool is_scalar = std::is_floating_point_v<T>;

template <class T>
concept Scalar = is_scalar<T>;

template <Scalar T>
inline constexpr T pi = T(std::numbers::pi_v<long double>);

template <>
inline constexpr float pi<float> = std::numbers::pi_v<float>;

template <>
inline constexpr double pi<double> = std::numbers::pi_v<double>;

/// Where squares of T are compared or summed: double for float, whose range they leave, else T.
template <Scalar T>
using wider_t = std::conditional_t<std::is_same_v<T, float>, double, T>;

/// The square: so that r2 = square(r) reads as it is meant.
template <class T>
[[nodiscard]] constexpr T square(const T& x) {
    return x * x;
}

// Unqualified calls inside the library find these for built-in types and the user's own by argument-dependent look-up.
using std::abs;
using std::cos;
using std::sin;
using std::sqrt;

/// Neither infinite nor NaN. By the exponent's bits: compilers take std::isfinite for true under -ffast-math.
[[nodiscard]] constexpr bool isfinite(float x) { return (~std::bit_cast<std::uint32_t>(x) & 0x7f800000u) != 0; }
[[nodiscard]] constexpr bool isfinite(double x) {
    return (~std::bit_cast<std::uint64_t>(x) & 0x7ff0000000000000u) != 0;
}
[[nodiscard]] inline bool isfinite(long double x) { return std::isfinite(x); }

} // namespace nephroid
