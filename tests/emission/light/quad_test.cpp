// SPDX-License-Identifier: MIT
#include "nephroid/emission/light/quad.hpp"

#include "nephroid/vector/glm.hpp"

#include "emission/light/light_laws.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <stdexcept>

namespace nephroid::tests::quad_test {

static_assert(Light<QuadLight<glm::vec3, float>>);
static_assert(Light<QuadLight<glm::vec3, glm::vec3>>);

namespace {

template <class T>
using Quad = QuadLight<glm::vec<3, T>, T>;
using D = glm::dvec3;

// Area 6, shining down.
template <class T>
Quad<T> overhead(const std::optional<BoundingSphere<glm::vec<3, T>>>& target) {
    return Quad<T>({.corner = {-1, -1, 4}, .edge_u = {0, 3, 0}, .edge_v = {2, 1, 0}, .radiance = 2, .target = target});
}

SurfacePoint overhead_point(double a, double b) { return {D(-1 + 2 * b, -1 + 3 * a + b, 4), D(0, 0, -1), 6}; }

} // namespace

TEST_CASE_TEMPLATE("quad light: laws of lights hold and tangents are aligned in scenes of any size", T, float, double) {
    using V = glm::vec<3, T>;
    check_light_laws(overhead<T>(std::nullopt), 4);
    check_aligned(overhead<T>(std::nullopt));
    for (const T size : {T(1e-4), T(1), T(1e5)}) {
        const V corner(1e5, 0, 0);
        const Quad<T> light({.corner = corner,
                             .edge_u = size * V(0, 1, 1),
                             .edge_v = size * V(1, 0, 1),
                             .radiance = 2,
                             .target = BoundingSphere<V>{corner + size * V(2, 3, -4), size}});
        check_light_laws(light, 4);
        check_aligned(light);
    }
}

TEST_CASE_TEMPLATE("quad light: unaimed the flux is pi times radiance times area", T, float, double) {
    check_same<T>(flux_of(overhead<T>(std::nullopt), 100), pi<double> * 2 * 6);
}

TEST_CASE("quad light: aimed the flux is the integral over the target's cone") {
    for (const auto& target : {BoundingSphere<D>{{0, 1, 0}, 1}, BoundingSphere<D>{{4, 1, 4}, 1.5}}) {
        CAPTURE(target.centre.x);
        const Integral expected = flux_into(target, 2, overhead_point);
        REQUIRE(expected.error < 0.02 * expected.value);
        check_same<double>(flux_of(overhead<double>(target), 50000, &target), expected.value, expected.error / 5);
    }
}

TEST_CASE("quad light: it emits on the side of edge_u x edge_v from corner to corner") {
    const Quad<double> light = overhead<double>(std::nullopt);
    GivenSamples samples({0.25, 0.75, 0.5, 0.5});
    const auto photon = light.emit(samples, Spread<double>{1, 1});
    CHECK(length(D(photon.position - D(0.5, 0.5, 4))) < 1e-15);
    CHECK(length(D(photon.direction - D(0, 0, -1))) < 1e-15);
}

TEST_CASE("quad light: parameters out of range are refused") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto make = [](glm::vec3 corner, glm::vec3 u, glm::vec3 v, float radiance) {
        return Quad<float>({.corner = corner, .edge_u = u, .edge_v = v, .radiance = radiance});
    };
    CHECK_NOTHROW(make({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1));
    CHECK_THROWS_AS(make({0, 0, nan}, {1, 0, 0}, {0, 1, 0}, 1), std::invalid_argument);
    CHECK_THROWS_AS(make({0, 0, 0}, {1, 0, 0}, {2, 0, 0}, 1), std::invalid_argument);
    CHECK_THROWS_AS(make({0, 0, 0}, {1, 0, 0}, {0, 0, 0}, 1), std::invalid_argument);
    CHECK_THROWS_AS(make({0, 0, 0}, {1, 0, nan}, {0, 1, 0}, 1), std::invalid_argument);
    CHECK_THROWS_AS(make({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, -1), std::invalid_argument);
}

} // namespace nephroid::tests::quad_test
