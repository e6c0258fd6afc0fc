// SPDX-License-Identifier: MIT
#include "common/fresnel.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace nephroid::examples::fresnel_test {

namespace {
template <class T>
constexpr T rounding = 16 * std::numeric_limits<T>::epsilon(); // a dozen operations on numbers of order one
}

TEST_CASE_TEMPLATE("fresnel: at normal incidence glass reflects the square of the relative step of the index", T, float,
                   double) {
    CHECK(std::abs(dielectric_reflectance<T>(1, T(1) / T(1.5)) - T(0.04)) < rounding<T>);
    CHECK(std::abs(dielectric_reflectance<T>(1, T(1.5)) - T(0.04)) < rounding<T>);
    CHECK(dielectric_reflectance<T>(1, 1) == 0);
    CHECK(dielectric_reflectance<T>(T(0.3), 1) < rounding<T>);
}

// tan θ = n: what is reflected has one polarisation only, ((n² − 1)/(n² + 1))² of it.
TEST_CASE_TEMPLATE("fresnel: at Brewster's angle only one polarisation is reflected", T, float, double) {
    for (const T n : {T(1.33), T(1.5), T(2.4)}) {
        const T cosine = 1 / std::sqrt(1 + n * n), s = (n * n - 1) / (n * n + 1);
        CHECK(std::abs(dielectric_reflectance<T>(cosine, 1 / n) - s * s / 2) < rounding<T>);
    }
}

TEST_CASE_TEMPLATE("fresnel: all is reflected from the critical angle on and at grazing incidence", T, float, double) {
    const T n = T(1.5), critical = std::sqrt(1 - 1 / (n * n));
    CHECK(dielectric_reflectance<T>(critical * (1 - rounding<T>), n) == 1);
    CHECK(dielectric_reflectance<T>(T(0.1), n) == 1);
    CHECK(dielectric_reflectance<T>(critical * T(1.0001), n) < 1);
    CHECK(dielectric_reflectance<T>(0, 1 / n) == 1);
    CHECK(conductor_reflectance<T>(0, T(0.2), T(3)) == 1);
}

// Reflectance and transmittance are computed apart: T = (n₂ c₂)/(n₁ c₁) · mean of the squared amplitudes
// 2 n₁ c₁/(…).
TEST_CASE_TEMPLATE("fresnel: what is reflected and what is transmitted add up to one", T, float, double) {
    const T eta = 1 / T(1.5);
    for (T c = T(0.05); c <= 1; c += T(0.05)) {
        const T c2 = std::sqrt(1 - eta * eta * (1 - c * c));
        const T s = 2 * eta * c / (eta * c + c2), p = 2 * eta * c / (c + eta * c2);
        const T transmitted = c2 / (eta * c) * (s * s + p * p) / 2;
        CHECK(std::abs(dielectric_reflectance<T>(c, eta) + transmitted - 1) < rounding<T>);
        // From within, the cosine is rounded: near the critical angle that is ten times as much.
        CHECK(std::abs(dielectric_reflectance<T>(c, eta) - dielectric_reflectance<T>(c2, 1 / eta)) < 10 * rounding<T>);
    }
}

// Gold at 650 nm, Johnson and Christy: 0.166 + 3.15 i.
TEST_CASE_TEMPLATE("fresnel: gold reflects at normal incidence as the closed form says", T, float, double) {
    const T n = T(0.166), k = T(3.15);
    const T expected = ((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k);
    CHECK(expected > T(0.94));
    CHECK(std::abs(conductor_reflectance<T>(1, n, k) - expected) < rounding<T>);
}

TEST_CASE_TEMPLATE("fresnel: a conductor that does not absorb is a dielectric", T, float, double) {
    for (T c = T(0.05); c <= 1; c += T(0.05))
        CHECK(std::abs(conductor_reflectance<T>(c, T(1.5), 0) - dielectric_reflectance<T>(c, 1 / T(1.5))) <
              rounding<T>);
}

// Born and Wolf's closed form for metals: a² + b² = |n² − sin²|, 2a² = |n² − sin²| + Re(n² − sin²).
TEST_CASE_TEMPLATE("fresnel: gold reflects at every angle as the real-valued formula says", T, float, double) {
    const T n = T(0.166), k = T(3.15);
    for (T c = T(0.1); c <= 1; c += T(0.1)) {
        const T sin2 = 1 - c * c, re = n * n - k * k - sin2, size = std::sqrt(re * re + 4 * n * n * k * k);
        const T a = std::sqrt((size + re) / 2), t = sin2 / c;
        const T s = (size - 2 * a * c + c * c) / (size + 2 * a * c + c * c);
        const T p = s * (size - 2 * a * t + t * t) / (size + 2 * a * t + t * t);
        // size + re cancels to about a hundredth of its terms.
        CHECK(std::abs(conductor_reflectance<T>(c, n, k) - (s + p) / 2) < 100 * rounding<T>);
    }
}

} // namespace nephroid::examples::fresnel_test
