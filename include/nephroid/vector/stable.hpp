// SPDX-License-Identifier: MIT
/// @file  Small algebra that does not cancel and does not branch.
#pragma once

#include "nephroid/vector/scalar.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace nephroid {

/// a b − c d, to within a few roundings of the exact value however much the products cancel.
///
/// float goes through double, where both products are exact; double uses fused multiply-add where the target has
/// one in hardware and Dekker's exact product elsewhere (a call to a software fma costs more than the difference).
/// Products must neither overflow nor underflow. Under `-ffast-math` the double version without hardware fma is as
/// accurate as the plain expression.
/// Source: Kahan, "On the cost of floating-point computation without extra-precise arithmetic", 2004; Dekker 1971.
template <Scalar T>
[[nodiscard]] constexpr T difference_of_products(const T& a, const T& b, const T& c, const T& d) {
    if constexpr (std::is_same_v<T, float>) {
        return float(double(a) * double(b) - double(c) * double(d));
    } else if constexpr (std::is_same_v<T, double>) {
#if defined(__FMA__) || defined(__ARM_FEATURE_FMA) || defined(FP_FAST_FMA) || (defined(_MSC_VER) && defined(__AVX2__))
        const double cd = c * d;
        const double error = std::fma(-c, d, cd);
        return std::fma(a, b, -cd) + error;
#else
        const auto product_error = [](double x, double y, double xy) {
            constexpr double splitter = 134217729.0; // 2^27 + 1 halves the 53 bits of a double
            const double sx = splitter * x, x_high = sx - (sx - x), x_low = x - x_high;
            const double sy = splitter * y, y_high = sy - (sy - y), y_low = y - y_high;
            return ((x_high * y_high - xy) + x_high * y_low + x_low * y_high) + x_low * y_low;
        };
        const double ab = a * b, cd = c * d;
        return (ab - cd) + (product_error(a, b, ab) - product_error(c, d, cd));
#endif
    } else {
        return a * b - c * d;
    }
}

/// value where the condition holds, else zero, as a mask instead of a branch: compilers vectorise loops over it
/// without being told that comparing floating-point numbers has no side effects, and a NaN that is not kept is gone.
template <Scalar T>
[[nodiscard]] constexpr T keep_if(bool condition, const T& value) {
    if constexpr (std::is_same_v<T, float>)
        return std::bit_cast<float>(std::bit_cast<std::uint32_t>(value) & (0u - std::uint32_t(condition)));
    else if constexpr (std::is_same_v<T, double>)
        return std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) &
                                     (std::uint64_t(0) - std::uint64_t(condition)));
    else
        return condition ? value : T(0);
}

/// A 2 x 2 matrix by columns: x = (xx, yx), y = (xy, yy).
template <Scalar T>
struct Matrix2 {
    T xx, xy;
    T yx, yy;
};

template <Scalar T>
[[nodiscard]] constexpr T determinant(const Matrix2<T>& m) {
    return difference_of_products(m.xx, m.yy, m.xy, m.yx);
}

/// The singular values of a 2 x 2 matrix, major >= minor >= 0.
template <Scalar T>
struct SingularValues {
    T major;
    T minor;
};

/// Singular values without squaring the condition number: the major one from the conformal and anticonformal
/// parts, the minor one as |det| / major, so both are accurate to a few roundings down to axis ratios of 1/epsilon.
template <Scalar T>
[[nodiscard]] SingularValues<T> singular_values(const Matrix2<T>& m) {
    const T sum = sqrt(square(m.xx + m.yy) + square(m.yx - m.xy));
    const T difference = sqrt(square(m.xx - m.yy) + square(m.yx + m.xy));
    const T major = T(0.5) * (sum + difference);
    if (!(major > T(0)))
        return {major, major}; // zero, or NaN, which must not pass for a point
    return {major, (std::min)(major, abs(determinant(m)) / major)};
}

} // namespace nephroid
