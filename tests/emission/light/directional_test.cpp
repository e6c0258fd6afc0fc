// SPDX-License-Identifier: MIT
#include "nephroid/emission/light/directional.hpp"

#include "nephroid/vector/glm.hpp"

#include "emission/light/light_laws.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

namespace nephroid::tests::directional_test {

static_assert(Light<DirectionalLight<glm::vec3, float>>);
static_assert(Light<DirectionalLight<glm::vec3, glm::vec3>>);

namespace {
template <class T>
using Sun = DirectionalLight<glm::vec<3, T>, T>;
} // namespace

TEST_CASE_TEMPLATE("directional light: laws of lights hold for each patch and in scenes of any size", T, float,
                   double) {
    using V = glm::vec<3, T>;
    for (const T size : {T(1e-4), T(1), T(1e5)}) {
        const V direction(1, -2, T(0.1));
        check_light_laws(Sun<T>({.direction = direction, .irradiance = 2, .patch = BoundingSphere<V>{V(0), size}}), 2);
        check_light_laws(Sun<T>({.direction = direction, .irradiance = 2, .patch = BeamDisk<V>{V(1e5), size}}), 2);
        check_light_laws(Sun<T>({.direction = direction,
                                 .irradiance = 2,
                                 .patch = Parallelogram<V>{V(1e5), size * V(1, 0, 0), size * V(1, 1, 2)}}),
                         2);
    }
}

TEST_CASE_TEMPLATE("directional light: the flux is irradiance times the area across the beam", T, float, double) {
    using V = glm::vec<3, T>;
    const Sun<T> disk({.direction = {0, 0, -2}, .irradiance = 3, .patch = BeamDisk<V>{{0, 0, 4}, 2}});
    check_same<T>(flux_of(disk, 100), 3 * pi<double> * 4);
    const Sun<T> over_sphere({.direction = {1, 1, -2}, .irradiance = 3, .patch = BoundingSphere<V>{{0, 0, 4}, 2}});
    check_same<T>(flux_of(over_sphere, 100), 3 * pi<double> * 4);
    // The exact ring's: light along (cos e, 0, -sin e) on a horizontal 2 x 3 patch.
    const double e = 35 * pi<double> / 180;
    const Sun<T> slanted({.direction = {T(std::cos(e)), 0, T(-std::sin(e))},
                          .irradiance = T(1 / std::sin(e)),
                          .patch = Parallelogram<V>{{0, 0, 1}, {2, 0, 0}, {0, 3, 0}}});
    check_same<T>(flux_of(slanted, 100), 6);
    CHECK(slanted.power() == doctest::Approx(6).epsilon(8 * double(std::numeric_limits<T>::epsilon())));
}

TEST_CASE("directional light: tangents lie in the patch and their footprints cover it") {
    const glm::dvec3 edge_u(2, 0, 0), edge_v(1, 3, 0);
    const Sun<double> light(
        {.direction = {1, 0, -1}, .irradiance = 1, .patch = Parallelogram<glm::dvec3>{{0, 0, 1}, edge_u, edge_v}});
    const auto photon = photon_of(light, 3, 500, 2);
    CHECK(photon.differential[0].d_position.z == doctest::Approx(0).epsilon(1e-15));
    CHECK(photon.differential[1].d_position.z == doctest::Approx(0).epsilon(1e-15));
    const double footprint =
        pi<double> / 4 * length(cross(photon.differential[0].d_position, photon.differential[1].d_position));
    CHECK(500 * footprint == doctest::Approx(4 * 6).epsilon(1e-13));
    CHECK(length(photon.differential[0].d_direction) == 0);
    CHECK(length(photon.differential[1].d_direction) == 0);
}

TEST_CASE("directional light: a parallelogram is filled from corner to corner by the samples") {
    const Sun<double> light({.direction = {1, 0, -1},
                             .irradiance = 1,
                             .patch = Parallelogram<glm::dvec3>{{0, 0, 1}, {2, 0, 0}, {1, 3, 0}}});
    GivenSamples samples({0.25, 0.5});
    const auto photon = light.emit(samples, Spread<double>{1, 1});
    CHECK(length(glm::dvec3(photon.position - glm::dvec3(0.25 * 2 + 0.5, 1.5, 1))) < 1e-15);
}

TEST_CASE_TEMPLATE("directional light: photons over a sphere start outside of it and cover it", T, float, double) {
    using V = glm::vec<3, T>;
    for (const T offset : {T(0), T(1e5)}) {
        for (const T radius : {T(1), T(1e-4), T(1e6)}) {
            const BoundingSphere<V> sphere{V(offset), radius};
            const Sun<T> light({.direction = {1, 2, -3}, .irradiance = 1, .patch = sphere});
            Mean squared;
            for (std::uint64_t i = 0; i < 1000; ++i) {
                const V from_centre = photon_of(light, i, 1).position - sphere.centre;
                CHECK(dot(from_centre, light.direction()) < -radius);
                squared.add(double(length2(V(from_centre - dot(from_centre, light.direction()) * light.direction()))) /
                            double(radius) / double(radius));
            }
            // A disk's mean squared radius is half of its squared radius. Far off, coordinates are too coarse.
            if (offset == 0)
                check_same<T>(squared, 0.5);
        }
    }
}

// Whatever the patch, photons start before all of the scene, on the same lines as without it.
TEST_CASE("directional light: it starts outside of the scene that it is told of") {
    using V = glm::dvec3;
    const BoundingSphere<V> scene{{3, 0, 1}, 20};
    for (const BeamPatch<V>& patch :
         {BeamPatch<V>(BoundingSphere<V>{{0, 0, 1}, 1}), BeamPatch<V>(BeamDisk<V>{{0, 0, 2}, 1}),
          BeamPatch<V>(Parallelogram<V>{{0, 0, 2}, {2, 0, 0}, {0, 1, 1}}),
          BeamPatch<V>(BeamDisk<V>{{0, 0, 1000}, 1})}) { // further out than it need be, and stays there
        const V direction(0.6, 0, -0.8);
        const Sun<double> without({.direction = direction, .irradiance = 1, .patch = patch});
        const Sun<double> with({.direction = direction, .irradiance = 1, .patch = patch, .scene = scene});
        CHECK(with.power() == without.power());
        for (std::uint64_t i = 0; i < 100; ++i) {
            const V a = photon_of(without, i, 1).position, b = photon_of(with, i, 1).position;
            CHECK(dot(V(b - scene.centre), direction) <= -scene.radius);
            CHECK(length(cross(V(b - a), direction)) <= 1e-12 * 1000);
        }
    }
    CHECK_THROWS_AS(Sun<double>({.direction = {0, 0, -1},
                                 .irradiance = 1,
                                 .patch = BeamDisk<V>{{0, 0, 2}, 1},
                                 .scene = BoundingSphere<V>{{0, 0, 0}, 0}}),
                    std::invalid_argument);
}

// A wall 40 radii ahead of the glass stands in the way.
TEST_CASE("directional light: aimed at a sphere it starts far ahead of it") {
    using V = glm::dvec3;
    const Sun<double> light({.direction = {0, 0, -1}, .irradiance = 1, .patch = BoundingSphere<V>{{0, 0, 0}, 2}});
    CHECK(photon_of(light, 1, 1).position.z > 80);
}

TEST_CASE("directional light: aiming at a sphere leaves the flux through it unchanged") {
    const BoundingSphere<glm::dvec3> target{{1, 2, 3}, 1.5};
    const Sun<double> wide(
        {.direction = {1, 2, -3}, .irradiance = 2, .patch = BoundingSphere<glm::dvec3>{{1, 1, 2.5}, 6}});
    const Sun<double> aimed({.direction = {1, 2, -3}, .irradiance = 2, .patch = target});
    check_same<double>(flux_of(wide, 100000, &target), aimed.power());
    CHECK(flux_of(aimed, 10000, &target).value() == doctest::Approx(aimed.power()).epsilon(1e-12));
}

// Its patch is all that shines: a wider one would be more light, from elsewhere.
TEST_CASE("directional light: a laser that is aimed stays the same laser") {
    using V = glm::dvec3;
    const BoundingSphere<V> ball{{0.5, 0.3, 0.5}, 0.2};
    for (const BeamPatch<V>& patch :
         {BeamPatch<V>(BeamDisk<V>{{0.5, 0.9, 0.5}, 0.01}),
          BeamPatch<V>(Parallelogram<V>{{0.5, 0.9, 0.5}, {0, 0, 0.01}, {0.01, 0.005, 0}})}) {
        const Sun<double> laser({.direction = {0, -1, 0}, .irradiance = 1, .patch = patch});
        const Sun<double> aimed = laser.aimed_at(ball);
        CHECK(aimed.power() == laser.power());
        for (std::uint64_t i = 0; i < 20; ++i)
            CHECK(photon_of(aimed, i, 20).position == photon_of(laser, i, 20).position);
    }
}

TEST_CASE("directional light: what stands in the way of a sun still does once it is aimed, also twice") {
    using V = glm::dvec3;
    const Sun<double> sun({.direction = {0, 0, -1}, .irradiance = 2, .patch = BoundingSphere<V>{{5, 0, 0}, 3}});
    const double before = photon_of(sun, 1, 1).position.z;
    for (const BoundingSphere<V>& ball : {BoundingSphere<V>{{5, 1, 0}, 0.1}, BoundingSphere<V>{{6, 1, -2}, 0.5}}) {
        const Sun<double> aimed = sun.aimed_at(ball), twice = aimed.aimed_at({{5, 0, 1}, 0.01}).aimed_at(ball);
        CHECK(aimed.power() == doctest::Approx(2 * pi<double> * ball.radius * ball.radius).epsilon(1e-12));
        CHECK(photon_of(aimed, 1, 1).position.z >= before);
        CHECK(length(V(photon_of(aimed, 1, 1).position - photon_of(twice, 1, 1).position)) < 1e-9);
    }
}

TEST_CASE("directional light: parameters out of range are refused") {
    using V = glm::vec3;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto make = [](V direction, float irradiance, const BeamPatch<V>& patch) {
        return Sun<float>({.direction = direction, .irradiance = irradiance, .patch = patch});
    };
    const BeamDisk<V> disk{{0, 0, 0}, 1};
    CHECK_NOTHROW(make({0, 0, -1}, 1, disk));
    CHECK_THROWS_AS(make({0, 0, 0}, 1, disk), std::invalid_argument);
    CHECK_THROWS_AS(make({0, 0, -1}, -1, disk), std::invalid_argument);
    CHECK_THROWS_AS(make({0, 0, -1}, 1, BeamDisk<V>{{0, 0, 0}, 0}), std::invalid_argument);
    CHECK_THROWS_AS(make({0, 0, -1}, 1, BeamDisk<V>{{nan, 0, 0}, 1}), std::invalid_argument);
    CHECK_THROWS_AS(make({0, 0, -1}, 1, BoundingSphere<V>{{0, 0, 0}, -1}), std::invalid_argument);
    CHECK_THROWS_AS(make({0, 0, -1}, 1, Parallelogram<V>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}), std::invalid_argument);
    CHECK_THROWS_AS(make({0, 0, -1}, 1, Parallelogram<V>{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}), std::invalid_argument);
    CHECK_THROWS_AS(make({0, 0, -1}, 1, Parallelogram<V>{{0, nan, 0}, {1, 0, 0}, {0, 1, 0}}), std::invalid_argument);
}

} // namespace nephroid::tests::directional_test
