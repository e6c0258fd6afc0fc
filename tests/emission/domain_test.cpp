// SPDX-License-Identifier: MIT
#include "nephroid/emission/domain.hpp"

#include "emission/light/distance_to_kink.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace nephroid::tests::domain_test {

TEST_CASE("emission domain: unless told otherwise it is a square without kinks that ends at its edges") {
    constexpr EmissionDomain domain;
    static_assert(domain.coordinates == 2 && domain.extra_count() == 0);
    for (const Kinks kinks : domain.kinks)
        CHECK(kinks == Kinks::nowhere);
    for (const DomainEdge edge : domain.edges)
        CHECK(edge == DomainEdge::ends);
}

TEST_CASE("emission domain: extras are counted besides the coordinates") {
    static_assert(EmissionDomain{.coordinates = 4, .extras = {EmissionExtra::time}}.extra_count() == 1);
    static_assert(EmissionDomain{.extras = {EmissionExtra::wavelength, EmissionExtra::time}}.extra_count() == 2);
    CHECK(EmissionDomain{.extras = {EmissionExtra::wavelength}}.coordinates == 2);
}

// The distance is zero on each line, and next to it that along the line's normal.
TEST_CASE("emission domain: the distance to a kink is that to the nearest of its lines") {
    CHECK(distance_to_kink(Kinks::nowhere, 0.3, 0.7) == std::numeric_limits<double>::infinity());
    CHECK(distance_to_kink(Kinks::unknown, 0.3, 0.7) == 0);
    const double root = std::sqrt(0.5);
    for (const double t : {0.05, 0.2, 0.35, 0.45}) {
        CAPTURE(t);
        CHECK(distance_to_kink(Kinks::diagonals, t, t) == doctest::Approx(0));
        CHECK(distance_to_kink(Kinks::diagonals, 1 - t, t) == doctest::Approx(0));
        const double step = 0.01; // off the diagonal by step in each coordinate
        CHECK(distance_to_kink(Kinks::diagonals, t + step * root, t - step * root) == doctest::Approx(step));
    }
}

} // namespace nephroid::tests::domain_test
