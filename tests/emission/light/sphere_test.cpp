// SPDX-License-Identifier: MIT
#include "nephroid/emission/light/sphere.hpp"

#include "nephroid/vector/glm.hpp"

#include "emission/light/light_laws.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace nephroid::tests::sphere_test {

static_assert(Light<SphereLight<glm::vec3, float>>);
static_assert(Light<SphereLight<glm::vec3, glm::vec3>>);

namespace {

template <class T>
using Sphere = SphereLight<glm::vec<3, T>, T>;
using D = glm::dvec3;

template <class T>
Sphere<T> at_4(T radius, const std::optional<BoundingSphere<glm::vec<3, T>>>& target) {
    return Sphere<T>({.centre = {0, 0, 4}, .radius = radius, .radiance = 2, .target = target});
}

} // namespace

TEST_CASE_TEMPLATE("sphere light: laws of lights hold and tangents are aligned in scenes of any size", T, float,
                   double) {
    using V = glm::vec<3, T>;
    check_light_laws(at_4<T>(1, std::nullopt), 4);
    check_aligned(at_4<T>(1, std::nullopt));
    for (const T size : {T(1e-4), T(1), T(1e5)}) {
        const V centre(1e5, 0, 0);
        const Sphere<T> light({.centre = centre,
                               .radius = size,
                               .radiance = 2,
                               .target = BoundingSphere<V>{centre + size * V(2, 3, -4), size}});
        check_light_laws(light, 4);
        check_aligned(light);
    }
}

TEST_CASE_TEMPLATE("sphere light: unaimed the flux is pi times radiance times area", T, float, double) {
    const double expected = pi<double> * 2 * (4 * pi<double> * 0.25);
    check_same<T>(flux_of(at_4<T>(T(0.5), std::nullopt), 100), expected);
    CHECK(at_4<T>(T(0.5), std::nullopt).power() ==
          doctest::Approx(expected).epsilon(32 * double(std::numeric_limits<T>::epsilon())));
}

// Seen from outside a Lambertian sphere is a disk: from far away the flux into a small target is L π R² Ω, with a
// relative error of the order of (R² + R_t²) / d².
TEST_CASE("sphere light: a distant small target gets the flux of a disk of the same radius") {
    const BoundingSphere<D> target{{0, 0, 4 - 1000}, 1};
    const double expected = 2 * pi<double> * (pi<double> * 1e-6);
    const Mean measured = flux_of(at_4<double>(1, target), 100000);
    check_same<double>(measured, expected, 1e-6 * expected);
}

TEST_CASE("sphere light: aimed the flux is the integral over the target's cone") {
    // A target smaller than the light, and a larger one.
    for (const auto& target : {BoundingSphere<D>{{1, 0, 0}, 0.5}, BoundingSphere<D>{{1, 0, 0}, 2}}) {
        CAPTURE(target.radius);
        // The whole sphere about the axis to the target; the kink at the horizon costs the midpoint rule some accuracy.
        const D axis = normalize(D(target.centre - D(0, 0, 4)));
        const Integral expected = flux_into(target, 2, [&](double a, double b) -> SurfacePoint {
            const D normal = cap_direction(axis, frame_about(axis), 2.0,
                                           DiskPoint<double>{std::sqrt(a) * std::cos(2 * pi<double> * b),
                                                             std::sqrt(a) * std::sin(2 * pi<double> * b)});
            return {D(0, 0, 4) + normal, normal, 4 * pi<double>};
        });
        CAPTURE(expected.error);
        REQUIRE(expected.error < 0.03 * expected.value);
        check_same<double>(flux_of(at_4<double>(1, target), 50000, &target), expected.value, expected.error / 5);
    }
}

TEST_CASE("sphere light: aiming leaves the flux through the target unchanged and has less noise") {
    // At a distance, and touching the light; last one around it, where every photon starts in the target.
    for (const auto& target : {BoundingSphere<D>{{3, 1, 2}, 1}, BoundingSphere<D>{{0, 0, 2}, 1}}) {
        CAPTURE(target.centre.x);
        const Mean unaimed = flux_of(at_4<double>(1, std::nullopt), 100000, &target);
        const Mean aimed = flux_of(at_4<double>(1, target), 100000, &target);
        check_same<double>(aimed, unaimed.value(), unaimed.error());
        CHECK(aimed.error() < unaimed.error());
    }
    const Mean inside = flux_of(at_4<double>(1, BoundingSphere<D>{{0, 0, 4}, 3}), 100);
    check_same<double>(inside, pi<double> * 2 * 4 * pi<double>);
}

// The target reaches above the horizon of the point with normal n if (c - x) · n + R_t > 0.
TEST_CASE("sphere light: aimed it emits from the normals that see the target and no others") {
    for (const double target_radius : {0.2, 1.0, 2.5}) {
        const BoundingSphere<D> target{{1, 2, -1}, target_radius};
        const Sphere<double> light = at_4<double>(1, target);
        const D centre(0, 0, 4), axis = normalize(D(target.centre - centre));
        double lowest = 1;
        for (std::uint64_t i = 0; i < 20000; ++i) {
            const D normal = photon_of(light, i, 1).position - centre;
            CHECK(dot(D(target.centre - centre - normal), normal) + target_radius > -1e-12);
            lowest = (std::min)(lowest, dot(normal, axis));
        }
        // The lowest of n cosines uniform in an interval of length h misses its end by more than 14 h / n with
        // probability exp(-14).
        const double end = (1 - target_radius) / length(D(target.centre - centre));
        CHECK(lowest <= end + 14 * (1 - end) / 20000);
    }
}

TEST_CASE("sphere light: parameters out of range are refused") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    using Target = BoundingSphere<glm::vec3>;
    CHECK_NOTHROW(at_4<float>(1, std::nullopt));
    CHECK_NOTHROW(at_4<float>(1, Target{{0, 0, 4}, 2}));
    CHECK_THROWS_AS(at_4<float>(0, std::nullopt), std::invalid_argument);
    CHECK_THROWS_AS(at_4<float>(nan, std::nullopt), std::invalid_argument);
    CHECK_THROWS_AS(at_4<float>(-1, std::nullopt), std::invalid_argument);
    CHECK_THROWS_AS(at_4<float>(3, Target{{0, 0, 3}, 1}), std::invalid_argument); // inside of the light
    CHECK_THROWS_AS(Sphere<float>({.centre = {0, nan, 0}, .radius = 1, .radiance = 1}), std::invalid_argument);
    CHECK_THROWS_AS(Sphere<float>({.centre = {0, 0, 0}, .radius = 1, .radiance = -1}), std::invalid_argument);
}

} // namespace nephroid::tests::sphere_test
