// SPDX-License-Identifier: MIT
/// @file  A scalar wider than double, for references: quadruple precision where the compiler has it. It is a class, so
///        it is also an example of a scalar that is not built in: the library runs on it (`is_scalar<Wide>`).
#pragma once

#include "nephroid/vector/scalar.hpp"

#include <cmath>
#include <concepts>
#include <limits>
#include <type_traits>

namespace nephroid::examples::numerics {

class Wide {
public:
#if defined(__SIZEOF_FLOAT128__)
    __extension__ typedef __float128 Number;
    static constexpr int digits = 113;
#else
    using Number = long double;
    static constexpr int digits = std::numeric_limits<long double>::digits;
#endif

    constexpr Wide() = default;
    template <class N>
        requires std::is_arithmetic_v<N>
    constexpr Wide(N number) : number_(static_cast<Number>(number)) {}
    static constexpr Wide of(Number number) {
        Wide wide;
        wide.number_ = number;
        return wide;
    }

    template <class N>
        requires std::is_arithmetic_v<N>
    explicit constexpr operator N() const { return static_cast<N>(number_); }

    friend constexpr Wide operator-(const Wide& a) { return of(-a.number_); }
    friend constexpr Wide operator+(const Wide& a, const Wide& b) { return of(a.number_ + b.number_); }
    friend constexpr Wide operator-(const Wide& a, const Wide& b) { return of(a.number_ - b.number_); }
    friend constexpr Wide operator*(const Wide& a, const Wide& b) { return of(a.number_ * b.number_); }
    friend constexpr Wide operator/(const Wide& a, const Wide& b) { return of(a.number_ / b.number_); }
    friend constexpr bool operator==(const Wide& a, const Wide& b) { return a.number_ == b.number_; }
    friend constexpr bool operator<(const Wide& a, const Wide& b) { return a.number_ < b.number_; }
    friend constexpr bool operator>(const Wide& a, const Wide& b) { return a.number_ > b.number_; }
    friend constexpr bool operator<=(const Wide& a, const Wide& b) { return a.number_ <= b.number_; }
    friend constexpr bool operator>=(const Wide& a, const Wide& b) { return a.number_ >= b.number_; }

    friend constexpr Wide abs(const Wide& a) { return a.number_ < 0 ? -a : a; }
    friend bool isfinite(const Wide& a) { return std::isfinite(static_cast<double>(a.number_)); }

    /// Newton's iteration from the root in double, which doubles the 53 correct digits at each step.
    friend Wide sqrt(const Wide& a) {
        if (!(a > Wide(0)))
            return a == Wide(0) ? a : Wide(std::numeric_limits<double>::quiet_NaN());
        if (a < Wide(0x1p-900)) // the square of a tiny double, which double cannot hold
            return sqrt(a * Wide(0x1p900)) * Wide(0x1p-450);
        Wide root = std::sqrt(static_cast<double>(a));
        for (int i = 0; i < 3; ++i)
            root = (root + a / root) * Wide(0.5);
        return root;
    }

private:
    Number number_ = 0;
};

/// 2^exponent.
[[nodiscard]] inline double power_of_two(int exponent) { return std::ldexp(1.0, exponent); }

} // namespace nephroid::examples::numerics

template <>
inline constexpr bool nephroid::is_scalar<nephroid::examples::numerics::Wide> = true;

template <>
class std::numeric_limits<nephroid::examples::numerics::Wide> : public std::numeric_limits<double> {
public:
    static constexpr int digits = nephroid::examples::numerics::Wide::digits;
    static nephroid::examples::numerics::Wide epsilon() { return std::ldexp(1.0, 1 - digits); }
};
