// SPDX-License-Identifier: MIT
/// @file  What every footprint kernel has to fulfil, beyond what the concept can ask the compiler.
#pragma once

#include "nephroid/footprint/kernel_mass.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>

namespace nephroid::tests {

/// ∫ x^(2m) k over the unit disk along one axis: m = 0 is its integral, m = 1 the second moment. In polar coordinates
/// 2π ∫ k r dr and π ∫ k r³ dr, by three-point Gauss quadrature on 256 panels: it never asks for r = 1, where a
/// kernel may jump, and leaves (1/256)^6 f⁗'' / 2016000, far below a rounding, for a kernel that is smooth in r up to
/// the edge.
template <class T, class K>
[[nodiscard]] double disk_moment(const K& kernel, int m) {
    constexpr int panels = 256;
    constexpr long double pi_l = std::numbers::pi_v<long double>;
    const long double offset = std::sqrt(0.6L);
    const std::array<long double, 3> nodes{-offset, 0, offset}, weights{5 / 9.0L, 8 / 9.0L, 5 / 9.0L};
    long double sum = 0;
    for (int i = 0; i < panels; ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            const long double r = (2 * i + 1 + nodes[k]) / (2 * panels);
            const T radius2 = static_cast<T>(r * r);
            sum += weights[k] * static_cast<long double>(kernel(radius2)) * (m == 0 ? 2 * r : r * r * r);
        }
    return static_cast<double>(pi_l * sum / (2 * panels));
}

/// ∫ k over the disk of a radius, by three-point Gauss quadrature on 256 panels, as above.
template <class T, class K>
[[nodiscard]] double disk_mass(const K& kernel, double radius) {
    constexpr int panels = 256;
    const double offset = std::sqrt(0.6);
    const std::array<double, 3> nodes{-offset, 0, offset}, weights{5.0 / 9, 8.0 / 9, 5.0 / 9};
    double sum = 0;
    for (int i = 0; i < panels; ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            const double r = radius * (2 * i + 1 + nodes[k]) / (2 * panels);
            sum += weights[k] * double(kernel(static_cast<T>(r * r))) * r;
        }
    return std::numbers::pi * radius * sum / panels;
}

/// Checks a kernel that the library brings along or a user's own, smooth in r on [0, 1), for one scalar type.
template <class K, class T>
    requires Kernel<K, T>
void check_kernel_laws(const K& kernel = K{}) {
    const double epsilon = static_cast<double>(std::numeric_limits<T>::epsilon());
    const double peak = static_cast<double>(kernel(T(0)));
    REQUIRE(std::isfinite(peak));
    REQUIRE(peak > 0);

    INFO("inside the disk: not negative, and falling (to four roundings of the peak)");
    double before = peak;
    for (int i = 0; i < 4096; ++i) {
        const double k = static_cast<double>(kernel(static_cast<T>(i / 4096.0)));
        REQUIRE(k >= 0);
        REQUIRE(k <= before + 4 * epsilon * peak);
        before = k;
    }
    const T below_one = T(1) - std::numeric_limits<T>::epsilon() / T(2);
    CHECK(kernel(below_one) >= T(0));
    CHECK(static_cast<double>(kernel(below_one)) <= before + 4 * epsilon * peak);

    INFO("on and outside of the edge: nothing, however far");
    for (const T radius2 : {T(1), T(1) + std::numeric_limits<T>::epsilon(), T(1.5), T(1e6), T(1e30),
                            std::numeric_limits<T>::max(), std::numeric_limits<T>::infinity()})
        CHECK(kernel(radius2) == T(0));

    INFO("normalised, with the second moment that it declares");
    // r² and k are rounded a few times. A slope like −1/r (the cone's) or 4.5 k (the Gaussian's) doubles or so what
    // r² contributes: 16 roundings in all.
    CHECK(std::abs(disk_moment<T>(kernel, 0) - 1) <= 16 * epsilon);
    const double second = static_cast<double>(K::second_moment);
    CHECK(std::abs(disk_moment<T>(kernel, 1) - second) <= 16 * epsilon * second);

    INFO("its mass within a radius: from nothing to all of it, and that of the integral");
    CHECK(double(detail::mass_within(kernel, T(0))) == 0);
    CHECK(std::abs(double(detail::mass_within(kernel, T(1))) - 1) <= 16 * epsilon);
    CHECK(detail::mass_within(kernel, T(4)) == detail::mass_within(kernel, T(1)));
    for (int i = 1; i < 16; ++i) {
        const double radius = i / 16.0; // whose square is exact
        CHECK(std::abs(double(detail::mass_within(kernel, T(radius * radius))) - disk_mass<T>(kernel, radius)) <=
              16 * epsilon);
    }

    // A box of side 1 has the variance 1/12 per axis, a disk of radius w with this kernel w² times the second moment.
    const double width = pixel_filter_width<K>;
    CHECK(std::abs(width * width * second - 1.0 / 12) <= 4 * std::numeric_limits<double>::epsilon() / 12);
}

} // namespace nephroid::tests
