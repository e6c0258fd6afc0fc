// SPDX-License-Identifier: MIT
/// @file  A dual number, a + b ε with ε² = 0: forward automatic differentiation. The library runs on it as on any scalar
///        (`is_scalar<Dual>`), so that a caustic can be differentiated by a parameter of the scene.
#pragma once

#include "nephroid/vector/scalar.hpp"

#include <cmath>
#include <limits>
#include <type_traits>

namespace nephroid::tests {

/// A value and its derivative by one parameter. Comparisons look at the value alone.
class Dual {
public:
    constexpr Dual() = default;
    template <class N>
        requires std::is_arithmetic_v<N>
    constexpr Dual(N value) : value_(static_cast<double>(value)) {}
    constexpr Dual(double value, double derivative) : value_(value), derivative_(derivative) {}

    [[nodiscard]] constexpr double value() const { return value_; }
    [[nodiscard]] constexpr double derivative() const { return derivative_; }

    template <class N>
        requires std::is_arithmetic_v<N>
    explicit constexpr operator N() const { return static_cast<N>(value_); }

    friend constexpr Dual operator-(const Dual& a) { return {-a.value_, -a.derivative_}; }
    friend constexpr Dual operator+(const Dual& a, const Dual& b) {
        return {a.value_ + b.value_, a.derivative_ + b.derivative_};
    }
    friend constexpr Dual operator-(const Dual& a, const Dual& b) {
        return {a.value_ - b.value_, a.derivative_ - b.derivative_};
    }
    friend constexpr Dual operator*(const Dual& a, const Dual& b) {
        return {a.value_ * b.value_, a.derivative_ * b.value_ + a.value_ * b.derivative_};
    }
    friend constexpr Dual operator/(const Dual& a, const Dual& b) {
        const double quotient = a.value_ / b.value_;
        return {quotient, (a.derivative_ - quotient * b.derivative_) / b.value_};
    }
    friend constexpr bool operator==(const Dual& a, const Dual& b) { return a.value_ == b.value_; }
    friend constexpr auto operator<=>(const Dual& a, const Dual& b) { return a.value_ <=> b.value_; }

    friend constexpr Dual abs(const Dual& a) { return a.value_ < 0 ? -a : a; }
    friend Dual sqrt(const Dual& a) {
        const double root = std::sqrt(a.value_);
        return {root,
                root > 0 ? a.derivative_ / (2 * root) : 0}; // at 0, where there is none: what is drawn there is zero
    }
    friend Dual sin(const Dual& a) { return {std::sin(a.value_), std::cos(a.value_) * a.derivative_}; }
    friend Dual cos(const Dual& a) { return {std::cos(a.value_), -std::sin(a.value_) * a.derivative_}; }
    friend Dual atan2(const Dual& y, const Dual& x) {
        const double r2 = x.value_ * x.value_ + y.value_ * y.value_;
        return {std::atan2(y.value_, x.value_),
                r2 > 0 ? (x.value_ * y.derivative_ - y.value_ * x.derivative_) / r2 : 0};
    }
    friend bool isfinite(const Dual& a) { return std::isfinite(a.value_) && std::isfinite(a.derivative_); }

private:
    double value_ = 0;
    double derivative_ = 0;
};

} // namespace nephroid::tests

template <>
inline constexpr bool nephroid::is_scalar<nephroid::tests::Dual> = true;

template <>
class std::numeric_limits<nephroid::tests::Dual> : public std::numeric_limits<double> {};
