// SPDX-License-Identifier: MIT
#include "nephroid/emission/spread.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>
#include <limits>
#include <numbers>

namespace nephroid::tests::spread_test {

// A footprint is the ellipse in the square of two tangents: π/4 length².
TEST_CASE_TEMPLATE("spread: the footprints' areas add up to the squared smoothing times the domain", T, float, double) {
    for (const T photons : {T(1), T(1000), T(1e7)}) {
        for (const T smoothing : {T(0.5), T(1), T(12)}) {
            for (const T measure : {T(1e-12), T(1), T(1e12)}) {
                const T length = Spread<T>{photons, smoothing}.length(measure);
                const T sum = photons * (std::numbers::pi_v<T> / 4 * length * length);
                const T expected = smoothing * smoothing * measure;
                CHECK(std::abs(sum - expected) <=
                      8 * std::numeric_limits<T>::epsilon() * expected); // as many roundings
            }
        }
    }
}

TEST_CASE("spread: photons of a domain without extent have no footprint") {
    CHECK(Spread<float>{100, 5}.length(0) == 0);
}

} // namespace nephroid::tests::spread_test
