// SPDX-License-Identifier: MIT
#include "nephroid/emission/light/disk.hpp"

#include "nephroid/vector/glm.hpp"

#include "emission/light/light_laws.hpp"
#include "support/sphere_direction.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace nephroid::tests::disk_test {

static_assert(Light<DiskLight<glm::vec3, float>>);
static_assert(Light<DiskLight<glm::dvec3, glm::dvec3>>);

namespace {

template <class T>
using Disk = DiskLight<glm::vec<3, T>, T>;
using D = glm::dvec3;

// A disk of radius 1 that shines down from z = 4.
template <class T>
Disk<T> overhead(const std::optional<BoundingSphere<glm::vec<3, T>>>& target) {
    return Disk<T>({.centre = {0, 0, 4}, .normal = {0, 0, -3}, .radius = 1, .radiance = 2, .target = target});
}

SurfacePoint overhead_point(double a, double b) {
    const double r = std::sqrt(a);
    return {D(r * std::cos(2 * pi<double> * b), r * std::sin(2 * pi<double> * b), 4), D(0, 0, -1), pi<double>};
}

} // namespace

TEST_CASE_TEMPLATE("disk light: laws of lights hold and tangents are aligned in scenes of any size", T, float, double) {
    using V = glm::vec<3, T>;
    check_light_laws(overhead<T>(std::nullopt), 4);
    check_aligned(overhead<T>(std::nullopt));
    for (const T size : {T(1e-4), T(1), T(1e5)}) {
        const V centre(1e5, 0, 0);
        const Disk<T> light({.centre = centre,
                             .normal = {0, 1, 1},
                             .radius = size,
                             .radiance = 2,
                             .target = BoundingSphere<V>{centre + size * V(0, 3, T(-0.5)), size}});
        check_light_laws(light, 4);
        check_aligned(light);
    }
}

TEST_CASE_TEMPLATE("disk light: unaimed the flux is pi times radiance times area", T, float, double) {
    const double expected = pi<double> * 2 * pi<double>;
    check_same<T>(flux_of(overhead<T>(std::nullopt), 100), expected);
    CHECK(overhead<T>(std::nullopt).power() ==
          doctest::Approx(expected).epsilon(32 * double(std::numeric_limits<T>::epsilon())));
}

TEST_CASE("disk light: aimed the flux is the integral over the target's cone") {
    // Straight below, aside, half below the horizon, and one so near that points see it under more than pi steradian.
    for (const auto& target : {BoundingSphere<D>{{0, 0, 0}, 1}, BoundingSphere<D>{{3, 1, 2}, 1},
                               BoundingSphere<D>{{4, 0, 4}, 1}, BoundingSphere<D>{{0.5, 0, 2}, 1.5}}) {
        CAPTURE(target.centre.x);
        const Integral expected = flux_into(target, 2, overhead_point);
        CAPTURE(expected.error);
        REQUIRE(expected.error < 0.02 * expected.value);
        const Disk<double> light = overhead<double>(target);
        const Mean measured = flux_of(light, 50000, &target);
        check_same<double>(measured, expected.value, expected.error / 5);
        // Shares among lights need no more than that.
        CHECK(light.power() > 0.8 * expected.value);
    }
}

TEST_CASE("disk light: aiming leaves the flux through the target unchanged and has less noise") {
    for (const auto& target :
         {BoundingSphere<D>{{0, 0, 0}, 1}, BoundingSphere<D>{{3, 1, 2}, 1}, BoundingSphere<D>{{4, 0, 4}, 1}}) {
        CAPTURE(target.centre.x);
        const Mean unaimed = flux_of(overhead<double>(std::nullopt), 100000, &target);
        const Mean aimed = flux_of(overhead<double>(target), 100000, &target);
        check_same<double>(aimed, unaimed.value(), unaimed.error());
        CHECK(aimed.error() < unaimed.error());
    }
}

// Footprints at emission: π/4 |Dx|² adds up to s² area, and π/4 |Dω|² on average to s² times the solid angle.
// The mean of 1/p over a density p is the measure of its domain, here the hemisphere's 2π; its variance is infinite,
// hence the strata.
TEST_CASE("disk light: footprints cover the area and the solid angle") {
    const Disk<double> light = overhead<double>(std::nullopt);
    const int n = 400;
    double solid_angle = 0;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            GivenSamples samples({0.3, 0.6, (i + 0.5) / n, (j + 0.5) / n});
            const auto photon = light.emit(samples, Spread<double>{double(n) * n, 3});
            const auto& [u, v] = photon.differential;
            CHECK(double(n) * n * pi<double> / 4 * length(cross(u.d_position, v.d_position)) ==
                  doctest::Approx(9 * pi<double>).epsilon(1e-12));
            solid_angle += pi<double> / 4 * length(cross(u.d_direction, v.d_direction));
        }
    }
    // Of the rim's square root, 1/cos, a midpoint rule misses about 0.6 of its last interval's 2 sqrt(2 · 2/n) part.
    CHECK(solid_angle == doctest::Approx(9 * 2 * pi<double>).epsilon(0.6 * std::sqrt(4.0 / n)));
}

TEST_CASE(
    "disk light: every point of the target is reached from every point of the light that it is above the horizon of") {
    const BoundingSphere<D> target{{1, 0, 0}, 1};
    const RandomSequence random(9);
    const Disk<double> light = overhead<double>(target);
    for (std::uint64_t i = 0; i < 500; ++i) {
        const auto photon = photon_of(light, i, 1);
        const D to_point =
            normalize(D(target.centre +
                        target.radius * sphere_direction<D>(random.sample<double>(i, 0), random.sample<double>(i, 1)) -
                        photon.position));
        const Cone<D> cone = cone_towards(target, photon.position);
        CHECK(0.5 * length2(D(to_point - cone.axis)) <= cone.height);                       // it is in the cone,
        CHECK(0.5 * length2(D(photon.direction - cone.axis)) <= cone.height * (1 + 1e-14)); // which is what is sampled
        CHECK(length(photon.differential[0].d_direction) ==                                 // uniformly
              doctest::Approx(Spread<double>{1, 1}.length(cone.solid_angle())).epsilon(1e-13));
    }
}

// The frame about the target turns with the point that it is seen from, although the axis' z changes sign within the
// light, where a frame made from the axis alone jumps.
TEST_CASE("disk light: the direction changes continuously over the light") {
    const Disk<double> light({.centre = {0, 0, 0},
                              .normal = {1, 0, 0},
                              .radius = 1,
                              .radiance = 1,
                              .target = BoundingSphere<D>{{4, 0, 0}, 1}});
    D previous(0);
    for (int i = 0; i <= 1000; ++i) {
        GivenSamples samples({i / 1000.0, 0.5, 0.9, 0.2});
        const D direction = light.emit(samples, Spread<double>{1, 1}).direction;
        if (i > 0)
            CHECK(length(D(direction - previous)) < 0.002); // the axis turns by 2/1000 · 1/4, the frame by less
        previous = direction;
    }
}

TEST_CASE("disk light: parameters out of range are refused") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto make = [](glm::vec3 centre, glm::vec3 normal, float radius, float radiance) {
        return Disk<float>({.centre = centre, .normal = normal, .radius = radius, .radiance = radiance});
    };
    CHECK_NOTHROW(make({0, 0, 0}, {0, 0, 5}, 1, 1));
    CHECK_THROWS_AS(make({0, nan, 0}, {0, 0, 5}, 1, 1), std::invalid_argument);
    CHECK_THROWS_AS(make({0, 0, 0}, {0, 0, 0}, 1, 1), std::invalid_argument);
    CHECK_THROWS_AS(make({0, 0, 0}, {0, 0, 5}, 0, 1), std::invalid_argument);
    CHECK_THROWS_AS(make({0, 0, 0}, {0, 0, 5}, -1, 1), std::invalid_argument);
    CHECK_THROWS_AS(make({0, 0, 0}, {0, 0, 5}, nan, 1), std::invalid_argument);
    CHECK_THROWS_AS(make({0, 0, 0}, {0, 0, 5}, 1, -1), std::invalid_argument);
}

} // namespace nephroid::tests::disk_test
