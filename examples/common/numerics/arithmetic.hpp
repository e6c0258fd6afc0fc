// SPDX-License-Identifier: MIT
/// @file  Two kinds of numbers in which the tests compute paths: `Wide`, for references, and `Dual`, which carries its
///        derivatives, for condition numbers; and points over either.
#pragma once

#include "common/numerics/space.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace nephroid::examples::numerics {

/// A double and its derivatives by two parameters: forward differentiation.
struct Dual {
    double value = 0;
    std::array<double, 2> d{};

    Dual() = default;
    Dual(double number) : value(number) {}
    Dual(double number, double d0, double d1) : value(number), d{d0, d1} {}

    friend Dual operator-(const Dual& a) { return {-a.value, -a.d[0], -a.d[1]}; }
    friend Dual operator+(const Dual& a, const Dual& b) {
        return {a.value + b.value, a.d[0] + b.d[0], a.d[1] + b.d[1]};
    }
    friend Dual operator-(const Dual& a, const Dual& b) {
        return {a.value - b.value, a.d[0] - b.d[0], a.d[1] - b.d[1]};
    }
    friend Dual operator*(const Dual& a, const Dual& b) {
        return {a.value * b.value, a.d[0] * b.value + a.value * b.d[0], a.d[1] * b.value + a.value * b.d[1]};
    }
    friend Dual operator/(const Dual& a, const Dual& b) {
        const double q = a.value / b.value;
        return {q, (a.d[0] - q * b.d[0]) / b.value, (a.d[1] - q * b.d[1]) / b.value};
    }
    friend Dual sqrt(const Dual& a) {
        const double root = std::sqrt(a.value);
        return {root, 0.5 * a.d[0] / root, 0.5 * a.d[1] / root};
    }
    friend Dual sin(const Dual& a) {
        const double c = std::cos(a.value);
        return {std::sin(a.value), c * a.d[0], c * a.d[1]};
    }
    friend Dual cos(const Dual& a) {
        const double s = std::sin(a.value);
        return {std::cos(a.value), -s * a.d[0], -s * a.d[1]};
    }
};

[[nodiscard]] inline double as_double(const Dual& a) { return a.value; }
[[nodiscard]] inline double as_double(const Wide& a) { return static_cast<double>(a); }
[[nodiscard]] inline double as_double(double a) { return a; }

/// The number of significant bits of a number's type.
template <class S>
inline constexpr int digits_of = 53;
template <>
inline constexpr int digits_of<Wide> = Wide::digits;

/// Sine and cosine by Taylor's series, after subtracting quarter turns.
struct SineCosine {
    Wide sine, cosine;
};

[[nodiscard]] inline SineCosine sine_cosine(const Wide& angle) {
    // Half of π, in three doubles.
    static const Wide quarter = Wide(1.5707963267948966) + Wide(6.123233995736766e-17) + Wide(-1.4973849048591833e-33);
    const double turns = std::nearbyint(static_cast<double>(angle / quarter));
    if (!std::isfinite(turns)) // a trial path that has left the scene
        return {angle - angle, angle - angle};
    const Wide x = angle - Wide(turns) * quarter, x2 = x * x;
    Wide sine(0), cosine(0);
    for (int n = 30; n > 0; n -= 2) { // |x| <= π/4: the next term is below 1e-36
        sine = Wide(1) - x2 / Wide(n * (n + 1)) * (n == 30 ? Wide(1) : sine);
        cosine = Wide(1) - x2 / Wide(n * (n - 1)) * (n == 30 ? Wide(1) : cosine);
    }
    sine = x * sine;
    switch (static_cast<int>(std::fmod(turns, 4.0)) & 3) {
    case 1:
        return {cosine, -sine};
    case 2:
        return {-sine, -cosine};
    case 3:
        return {-cosine, sine};
    default:
        return {sine, cosine};
    }
}

[[nodiscard]] inline Wide sine_of(const Wide& a) { return sine_cosine(a).sine; }
[[nodiscard]] inline Wide cosine_of(const Wide& a) { return sine_cosine(a).cosine; }
[[nodiscard]] inline Dual sine_of(const Dual& a) { return sin(a); }
[[nodiscard]] inline Dual cosine_of(const Dual& a) { return cos(a); }

/// A vector or a point.
template <class S>
struct Point {
    S x{}, y{}, z{};

    friend Point operator+(const Point& a, const Point& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend Point operator-(const Point& a) { return {-a.x, -a.y, -a.z}; }
    friend Point operator*(const S& s, const Point& a) { return {s * a.x, s * a.y, s * a.z}; }

    [[nodiscard]] S dot(const Point& b) const { return x * b.x + y * b.y + z * b.z; }
    [[nodiscard]] Point cross(const Point& b) const {
        return {y * b.z - z * b.y, z * b.x - x * b.z, x * b.y - y * b.x};
    }
    [[nodiscard]] S length() const {
        using std::sqrt;
        return sqrt(dot(*this));
    }
    [[nodiscard]] Point unit() const { return (S(1) / length()) * *this; }
    /// The vector without its part along the unit vector n.
    [[nodiscard]] Point across(const Point& n) const { return *this - dot(n) * n; }
};

template <class S, class From>
[[nodiscard]] Point<S> lift(const Point<From>& p) {
    if constexpr (std::is_same_v<S, double>)
        return {as_double(p.x), as_double(p.y), as_double(p.z)};
    else
        return {S(p.x), S(p.y), S(p.z)};
}

/// By its bits: -ffast-math makes std::isfinite always true.
[[nodiscard]] inline bool is_finite(double x) { return (std::bit_cast<std::uint64_t>(x) >> 52 & 0x7ff) != 0x7ff; }
[[nodiscard]] inline bool is_finite(const Point<double>& p) {
    return is_finite(p.x) && is_finite(p.y) && is_finite(p.z);
}

/// The derivative by parameter j.
[[nodiscard]] inline Point<double> derivative_of(const Point<Dual>& p, std::size_t j) {
    return {p.x.d[j], p.y.d[j], p.z.d[j]};
}

/// Two unit vectors orthogonal to the unit vector n and to each other.
[[nodiscard]] inline std::array<Point<double>, 2> two_across(const Point<double>& n) {
    const Point<double> other = std::abs(n.x) < 0.6 ? Point<double>{1, 0, 0} : Point<double>{0, 1, 0};
    const Point<double> u = n.cross(other).unit();
    return {u, n.cross(u)};
}

} // namespace nephroid::examples::numerics
