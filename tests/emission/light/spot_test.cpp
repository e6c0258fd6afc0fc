// SPDX-License-Identifier: MIT
#include "nephroid/emission/light/spot.hpp"

#include "nephroid/vector/glm.hpp"

#include "emission/light/light_laws.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace nephroid::tests::spot_test {

static_assert(Light<SpotLight<glm::vec3, float>>);
static_assert(Light<SpotLight<glm::dvec3, glm::dvec3>>);

namespace {
template <class T>
using Spot = SpotLight<glm::vec<3, T>, T>;
} // namespace

TEST_CASE_TEMPLATE("spot light: laws of lights hold with and without a target", T, float, double) {
    using V = glm::vec<3, T>;
    check_light_laws(
        Spot<T>({.position = {1, 2, 3}, .axis = {0, 1, -2}, .cos_inner = T(0.9), .cos_outer = T(0.5), .intensity = 4}),
        2);
    check_light_laws(
        Spot<T>({.position = {1, 2, 3}, .axis = {0, 1, -2}, .cos_inner = 1, .cos_outer = -1, .intensity = 4}), 2);
    check_light_laws(Spot<T>({.position = V(1e5),
                              .axis = {0, 1, -2},
                              .cos_inner = T(0.9),
                              .cos_outer = T(0.5),
                              .intensity = 4,
                              .target = BoundingSphere<V>{V(1e5) + V(0, 1, -2), T(0.2)}}),
                     2);
}

// ∫ falloff dω = 2 pi [(1 - c_inner) + (c_inner - c_outer) ∫ x² dx].
TEST_CASE_TEMPLATE("spot light: the flux is the closed form", T, float, double) {
    for (const auto& [inner, outer] : {std::pair{0.9, 0.5}, std::pair{1.0, -1.0}, std::pair{0.25, -0.5}}) {
        const Spot<T> light(
            {.position = {1, 2, 3}, .axis = {3, 1, -2}, .cos_inner = T(inner), .cos_outer = T(outer), .intensity = 4});
        const double expected = 4 * 2 * pi<double> * ((1 - inner) + (inner - outer) / 3);
        CHECK(light.power() == doctest::Approx(expected).epsilon(16 * double(std::numeric_limits<T>::epsilon())));
        check_same<T>(flux_of(light, 20000), expected);
    }
}

TEST_CASE("spot light: the intensity falls from the inner cone to the outer one") {
    const Spot<double> light(
        {.position = {0, 0, 0}, .axis = {0, 0, 7}, .cos_inner = 0.9, .cos_outer = 0.5, .intensity = 1});
    const auto at = [&](double cosine) { return light.falloff({std::sqrt(1 - cosine * cosine), 0, cosine}); };
    CHECK(at(1) == 1);
    CHECK(at(0.95) == 1);
    CHECK(at(0.7) == doctest::Approx(0.25).epsilon(1e-14)); // half way, squared
    CHECK(at(0.6) == doctest::Approx(0.0625).epsilon(1e-14));
    CHECK(at(0.49) == 0);
    CHECK(at(-1) == 0);
}

TEST_CASE("spot light: aiming leaves the flux through the target unchanged") {
    // Inside of the full cone, across the falloff, across its edge, wider than the spot.
    for (const auto& target : {BoundingSphere<glm::dvec3>{{0, 0, -4}, 0.5}, BoundingSphere<glm::dvec3>{{2, 0, -4}, 0.7},
                               BoundingSphere<glm::dvec3>{{5, 0, -4}, 2}, BoundingSphere<glm::dvec3>{{2, 0, -4}, 4}}) {
        CAPTURE(target.centre.x);
        Spot<double>::Options options{
            .position = {0, 0, 0}, .axis = {0, 0, -1}, .cos_inner = 0.95, .cos_outer = 0.7, .intensity = 2};
        const Mean unaimed = flux_of(Spot<double>(options), 100000, &target);
        options.target = target;
        const Spot<double> light(options);
        const Mean aimed = flux_of(light, 100000, &target);
        check_same<double>(aimed, unaimed.value(), unaimed.error());
        CHECK(aimed.error() <= unaimed.error());
        // 256 midpoints: 2 % where the outer cone's edge crosses the target.
        if (target.radius < 4)
            CHECK(light.power() == doctest::Approx(aimed.value()).epsilon(0.02));
    }
}

TEST_CASE("spot light: a target that the light cannot reach gets photons without flux") {
    const Spot<double> light({.position = {0, 0, 0},
                              .axis = {0, 0, -1},
                              .cos_inner = 0.95,
                              .cos_outer = 0.7,
                              .intensity = 2,
                              .target = BoundingSphere<glm::dvec3>{{0, 0, 4}, 1}});
    CHECK(flux_of(light, 1000).value() == 0);
}

TEST_CASE("spot light: parameters out of range are refused") {
    const auto make = [](glm::vec3 axis, float inner, float outer, float intensity) {
        return Spot<float>(
            {.position = {0, 0, 0}, .axis = axis, .cos_inner = inner, .cos_outer = outer, .intensity = intensity});
    };
    const float nan = std::numeric_limits<float>::quiet_NaN();
    CHECK_NOTHROW(make({0, 0, 1}, 0.9f, 0.5f, 1));
    CHECK_NOTHROW(make({0, 0, 1e-30f}, 0.9f, 0.5f, 1)); // its square is no longer a float
    CHECK_NOTHROW(make({0, 0, 1e30f}, 0.9f, 0.5f, 1));
    CHECK_THROWS_AS(make({0, 0, 0}, 0.9f, 0.5f, 1), std::invalid_argument);
    CHECK_THROWS_AS(make({0, nan, 0}, 0.9f, 0.5f, 1), std::invalid_argument);
    CHECK_THROWS_AS(make({0, 0, 1}, 0.5f, 0.5f, 1), std::invalid_argument);
    CHECK_THROWS_AS(make({0, 0, 1}, 0.5f, 0.9f, 1), std::invalid_argument);
    CHECK_THROWS_AS(make({0, 0, 1}, 1.1f, 0.9f, 1), std::invalid_argument);
    CHECK_THROWS_AS(make({0, 0, 1}, 0.9f, -1.1f, 1), std::invalid_argument);
    CHECK_THROWS_AS(make({0, 0, 1}, nan, 0.5f, 1), std::invalid_argument);
    CHECK_THROWS_AS(make({0, 0, 1}, 0.9f, nan, 1), std::invalid_argument);
    CHECK_THROWS_AS(make({0, 0, 1}, 0.9f, 0.5f, -1), std::invalid_argument);
}

} // namespace nephroid::tests::spot_test
