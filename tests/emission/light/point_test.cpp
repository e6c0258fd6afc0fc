// SPDX-License-Identifier: MIT
#include "nephroid/emission/light/point.hpp"

#include "nephroid/vector/glm.hpp"

#include "emission/light/light_laws.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace nephroid::tests::point_test {

static_assert(Light<PointLight<glm::vec3, float>>);
static_assert(Light<PointLight<glm::vec3, glm::vec3>>);
static_assert(Light<PointLight<glm::dvec3, float>>);
static_assert(!Light<int>);

TEST_CASE_TEMPLATE("point light: laws of lights hold with and without a target and in scenes of any size", T, float,
                   double) {
    using V = glm::vec<3, T>;
    using Point = PointLight<V, T>;
    check_light_laws(Point({.position = {1, 2, 3}, .intensity = 16}), 2);
    for (const T size : {T(1e-4), T(1), T(1e5)}) {
        const BoundingSphere<V> target{V(1e5, 0, 0) + V(0, 0, 3 * size), size};
        check_light_laws(Point({.position = V(1e5, 0, 0), .intensity = 16, .target = target}), 2);
    }
    check_light_laws(Point({.position = {0, 0, 0}, .intensity = 16, .target = BoundingSphere<V>{{0, 0, 1}, 2}}), 2);
}

// Each photon has the same flux, so the sum is exact: 4π I, or I times the target's solid angle, which is
// 2π (1 - sqrt(1 - R²/d²)).
TEST_CASE_TEMPLATE("point light: the flux is intensity times solid angle", T, float, double) {
    using V = glm::vec<3, T>;
    using Point = PointLight<V, T>;
    const double pi = std::acos(-1.0);
    const Point all({.position = {0, 0, 0}, .intensity = 16});
    check_same<T>(flux_of(all, 100), 4 * pi * 16);
    CHECK(all.power() == doctest::Approx(4 * pi * 16).epsilon(8 * double(std::numeric_limits<T>::epsilon())));

    const Point aimed({.position = {0, 0, 5.25}, .intensity = 16, .target = BoundingSphere<V>{{0, 0, T(1.25)}, 1}});
    const double expected = 16 * 2 * pi * (1 - std::sqrt(1 - 1.0 / 16));
    check_same<T>(flux_of(aimed, 100), expected);
    // 1 - cos loses some 5 bits here if taken literally; the cone is rounded up by 24 epsilon.
    CHECK(aimed.power() == doctest::Approx(expected).epsilon(48 * double(std::numeric_limits<T>::epsilon())));
}

TEST_CASE("point light: aiming leaves the flux through the target unchanged") {
    using Point = PointLight<glm::dvec3, double>;
    const BoundingSphere<glm::dvec3> target{{1, -2, 1}, 1.5};
    const Point unaimed({.position = {0, 0, 3}, .intensity = 2});
    const Point aimed({.position = {0, 0, 3}, .intensity = 2, .target = target});
    check_same<double>(flux_of(unaimed, 100000, &target), aimed.power());
    // Every aimed photon hits it, but for one on the rim that was rounded up.
    CHECK(flux_of(aimed, 10000, &target).value() == doctest::Approx(aimed.power()).epsilon(1e-3));
}

// |Dω|² π/4 is the photon's solid angle; all of them cover s² times the cone's.
TEST_CASE("point light: footprints cover the solid angle and start as points") {
    using Point = PointLight<glm::dvec3, double>;
    const Point light({.position = {0, 0, 3}, .intensity = 2, .target = BoundingSphere<glm::dvec3>{{0, 0, 0}, 1}});
    const auto photon = photon_of(light, 5, 1000, 3);
    CHECK(length(photon.differential[0].d_position) == 0);
    CHECK(length(photon.differential[1].d_position) == 0);
    const double footprint =
        pi<double> / 4 * length(cross(photon.differential[0].d_direction, photon.differential[1].d_direction));
    CHECK(1000 * footprint == doctest::Approx(9 * light.power() / 2).epsilon(1e-12));
}

TEST_CASE("point light: parameters out of range are refused with their name and value") {
    using Point = PointLight<glm::vec3, float>;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    CHECK_THROWS_WITH_AS(Point({.position = {nan, 0, 0}, .intensity = 1}),
                         "nephroid::PointLight: position (nan, 0, 0) is not finite; pass world coordinates",
                         std::invalid_argument);
    CHECK_THROWS_AS(Point({.position = {0, 0, 0}, .intensity = -1}), std::invalid_argument);
    CHECK_THROWS_AS(Point({.position = {0, 0, 0}, .intensity = nan}), std::invalid_argument);
    using Target = BoundingSphere<glm::vec3>;
    CHECK_THROWS_AS(Point({.position = {0, 0, 0}, .intensity = 1, .target = Target{{0, 0, 2}, 0}}),
                    std::invalid_argument);
    CHECK_THROWS_AS(Point({.position = {0, 0, 0}, .intensity = 1, .target = Target{{0, nan, 2}, 1}}),
                    std::invalid_argument);
    using Coloured = PointLight<glm::vec3, glm::vec3>;
    CHECK_THROWS_AS(Coloured({.position = {0, 0, 0}, .intensity = {3, -1, 3}}), std::invalid_argument);
    CHECK_NOTHROW(Point({.position = {0, 0, 0}, .intensity = 0}));
}

} // namespace nephroid::tests::point_test
