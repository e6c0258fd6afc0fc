// SPDX-License-Identifier: MIT
#include "nephroid/emission/emit_at.hpp"

#include "emission/light/coloured_sun.hpp"
#include "emission/light/light_laws.hpp"

#include "nephroid/emission/light/standard_lights.hpp"
#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>

#include <cstring>

namespace nephroid::tests::emit_at_test {

using tests::GivenSamples;

namespace {
using D = glm::dvec3;

template <class P>
[[nodiscard]] bool same_bits(const P& a, const P& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}
} // namespace

TEST_CASE("emit at: the photon of a point is the one that draws the point") {
    const Spread<double> spread{1000, 2};
    const PointLight<D, double> lamp({.position = {1, 2, 3}, .intensity = 5});
    GivenSamples two({0.25, 0.75});
    CHECK(same_bits(emit_at(lamp, {0.25, 0.75}, spread), lamp.emit(two, spread)));

    const DiskLight<D, double> disk({.centre = {0, 0, 2}, .normal = {0, 0, -1}, .radius = 1, .radiance = 3});
    GivenSamples four({0.1, 0.9, 0.3, 0.6});
    CHECK(same_bits(emit_at(disk, {0.1, 0.9, 0.3, 0.6}, spread), disk.emit(four, spread)));
}

TEST_CASE("emit at: a point may lie on the domain's edge") {
    const PointLight<D, double> lamp({.position = {0, 0, 0}, .intensity = 1});
    for (const double u : {0.0, 1.0})
        for (const double v : {0.0, 0.5, 1.0})
            CHECK(length(emit_at(lamp, {u, v}, Spread<double>{1, 1}).direction) == doctest::Approx(1).epsilon(1e-12));
}

TEST_CASE("emit at: extras are drawn from their own source or lie in the middle") {
    const tests::ColouredSun<D> sun;
    const Spread<double> spread{1, 1};
    GivenSamples red({0.9});
    const auto middle = emit_at(sun, {0.2, 0.3}, spread), other = emit_at(sun, {0.2, 0.3}, spread, red);
    CHECK(red.drawn() == 1);
    CHECK(middle.position == other.position);
    CHECK(middle.flux == doctest::Approx(0.5 * sun.power()));
    CHECK(other.flux == doctest::Approx(0.9 * sun.power()));
}

} // namespace nephroid::tests::emit_at_test
