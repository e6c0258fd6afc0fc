// SPDX-License-Identifier: MIT
/// @file  A dual number: a value and its derivatives by a few parameters, carried through any arithmetic.
#pragma once

#include "nephroid/vector/scalar.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>

namespace nephroid {

/// value + Σ derivative(i) εᵢ with εᵢ εⱼ = 0: forward automatic differentiation. It is a scalar for the whole
/// library, which can thus differentiate a caustic by parameters of the scene, and a photon's tangents by where it was
/// emitted (smoothing/second_order/exact_path_derivatives.hpp). Comparisons compare the values alone.
///
/// Where a function has no derivative (the root at 0), 0 stands for it.
///
/// @tparam T  the numbers: float, double, or a wider scalar
/// @tparam N  parameters, >= 1
template <Scalar T, std::size_t N = 1>
class Dual {
public:
    constexpr Dual() = default;
    template <class Number>
        requires std::is_arithmetic_v<Number>
    constexpr Dual(Number value) : value_(static_cast<T>(value)) {}
    constexpr Dual(const T& value, const std::array<T, N>& derivatives) : value_(value), derivatives_(derivatives) {}

    /// A parameter at a value: its derivative by itself is 1, by the others 0.
    [[nodiscard]] static constexpr Dual parameter(const T& value, std::size_t index = 0) {
        Dual dual;
        dual.value_ = value;
        dual.derivatives_[index] = T(1);
        return dual;
    }

    [[nodiscard]] constexpr const T& value() const { return value_; }
    [[nodiscard]] constexpr const T& derivative(std::size_t index = 0) const { return derivatives_[index]; }

    template <class Number>
        requires std::is_arithmetic_v<Number>
    explicit constexpr operator Number() const { return static_cast<Number>(value_); }

    friend constexpr Dual operator-(const Dual& a) { return a.chain(-a.value_, T(-1)); }
    friend constexpr Dual operator+(const Dual& a, const Dual& b) {
        return combined(a.value_ + b.value_, [&](std::size_t i) { return T(a.derivatives_[i] + b.derivatives_[i]); });
    }
    friend constexpr Dual operator-(const Dual& a, const Dual& b) {
        return combined(a.value_ - b.value_, [&](std::size_t i) { return T(a.derivatives_[i] - b.derivatives_[i]); });
    }
    friend constexpr Dual operator*(const Dual& a, const Dual& b) {
        return combined(a.value_ * b.value_,
                        [&](std::size_t i) { return T(a.derivatives_[i] * b.value_ + a.value_ * b.derivatives_[i]); });
    }
    friend constexpr Dual operator/(const Dual& a, const Dual& b) {
        const T quotient = a.value_ / b.value_;
        return combined(
            quotient, [&](std::size_t i) { return T((a.derivatives_[i] - quotient * b.derivatives_[i]) / b.value_); });
    }
    constexpr Dual& operator+=(const Dual& b) { return *this = *this + b; }
    constexpr Dual& operator-=(const Dual& b) { return *this = *this - b; }
    constexpr Dual& operator*=(const Dual& b) { return *this = *this * b; }
    constexpr Dual& operator/=(const Dual& b) { return *this = *this / b; }

    friend constexpr bool operator==(const Dual& a, const Dual& b) { return a.value_ == b.value_; }
    friend constexpr bool operator<(const Dual& a, const Dual& b) { return a.value_ < b.value_; }
    friend constexpr bool operator>(const Dual& a, const Dual& b) { return a.value_ > b.value_; }
    friend constexpr bool operator<=(const Dual& a, const Dual& b) { return a.value_ <= b.value_; }
    friend constexpr bool operator>=(const Dual& a, const Dual& b) { return a.value_ >= b.value_; }

    friend constexpr Dual abs(const Dual& a) { return a.value_ < T(0) ? -a : a; }
    friend Dual sqrt(const Dual& a) {
        using std::sqrt;
        const T root = sqrt(a.value_);
        return a.chain(root, root > T(0) ? T(T(0.5) / root) : T(0));
    }
    friend Dual sin(const Dual& a) {
        using std::cos, std::sin;
        return a.chain(sin(a.value_), cos(a.value_));
    }
    friend Dual cos(const Dual& a) {
        using std::cos, std::sin;
        return a.chain(cos(a.value_), -sin(a.value_));
    }
    friend Dual exp(const Dual& a) {
        using std::exp;
        const T power = exp(a.value_);
        return a.chain(power, power);
    }
    friend Dual atan2(const Dual& y, const Dual& x) {
        using std::atan2;
        const T r2 = x.value_ * x.value_ + y.value_ * y.value_;
        return combined(atan2(y.value_, x.value_), [&](std::size_t i) {
            return r2 > T(0) ? T((x.value_ * y.derivatives_[i] - y.value_ * x.derivatives_[i]) / r2) : T(0);
        });
    }
    friend bool isfinite(const Dual& a) {
        using nephroid::isfinite;
        bool all = isfinite(a.value_);
        for (const T& d : a.derivatives_)
            all = all && isfinite(d);
        return all;
    }

private:
    template <class Derivative>
    [[nodiscard]] static constexpr Dual combined(const T& value, const Derivative& derivative) {
        Dual result;
        result.value_ = value;
        for (std::size_t i = 0; i < N; ++i)
            result.derivatives_[i] = derivative(i);
        return result;
    }

    /// f(this), from the value and the slope of f there.
    [[nodiscard]] constexpr Dual chain(const T& value, const T& slope) const {
        return combined(value, [&](std::size_t i) { return T(slope * derivatives_[i]); });
    }

    T value_ = T(0);
    std::array<T, N> derivatives_{};
};

template <class T, std::size_t N>
inline constexpr bool is_scalar<Dual<T, N>> = true;

} // namespace nephroid

/// @cond  Doxygen looks for the class in nephroid
// Those of the value; what they return is of type T.
template <class T, std::size_t N>
class std::numeric_limits<nephroid::Dual<T, N>> : public std::numeric_limits<T> {};
/// @endcond
