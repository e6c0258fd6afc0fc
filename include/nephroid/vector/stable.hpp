// SPDX-License-Identifier: MIT
/// @file  Arithmetic that neither cancels nor branches.
#pragma once

#include "nephroid/vector/bits.hpp"
#include "nephroid/vector/scalar.hpp"

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

/// The value where the condition holds, else zero, by a mask instead of a branch: compilers can vectorise loops over
/// it, and a NaN that is not kept has no effect.
template <Scalar T>
[[nodiscard]] constexpr T keep_if(bool condition, const T& value) {
    if constexpr (std::is_same_v<T, float>)
        return detail::bit_cast<float>(detail::bit_cast<std::uint32_t>(value) & (0u - std::uint32_t(condition)));
    else if constexpr (std::is_same_v<T, double>)
        return detail::bit_cast<double>(detail::bit_cast<std::uint64_t>(value) &
                                        (std::uint64_t(0) - std::uint64_t(condition)));
    else
        return condition ? value : T(0);
}

/// The singular values of a 2 × 2 matrix, major >= minor >= 0.
template <Scalar T>
struct SingularValues {
    T major;
    T minor;
};

} // namespace nephroid
