// SPDX-License-Identifier: MIT
#include "common/builtin_cases.hpp"
#include "common/scene.hpp"

#include "examples/worlds.hpp"

#include "nephroid/emission/light/standard_lights.hpp"
#include "nephroid/sequence/halton.hpp"
#include "nephroid/transport/walk.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

namespace nephroid::examples::scene_test {

using namespace nephroid::examples::testing;
using nephroid::Event;
using nephroid::Fate;

static_assert(nephroid::Scene<Scene<float, float>, Vec3<float>, ListSampler>);
static_assert(nephroid::Scene<Scene<float>, Vec3<float>, ListSampler>);
static_assert(nephroid::Scene<Scene<double, double>, Vec3<double>, ListSampler>);
static_assert(nephroid::Scene<Scene<double>, Vec3<double>, ListSampler>);
static_assert(nephroid::Absorbs<Scene<float>, Vec3<float>>);

namespace {

template <class T>
using Colors = Material<Vec3<T>>;

template <class T>
Scene<T> one_sphere(const Colors<T>& material) {
    return Scene<T>({{Sphere<T>({0, 0, 0}, 1), 0}}, {material});
}

/// What happens to a photon that meets a sphere head on, from outside or from within.
template <class T>
Bounce<T, Vec3<T>> bounce(const Colors<T>& material, bool from_within, ListSampler& sampler) {
    const Scene<T> scene = one_sphere(material);
    const Vec3<T> direction(0, 0, from_within ? 1 : -1);
    const auto hit = scene.intersect({0, 0, from_within ? T(0) : T(3)}, direction, T(0), T(10));
    REQUIRE(hit.has_value());
    return scene.scatter(*hit, direction, sampler);
}

/// Photons as a light and a sequence give them; the walk books all but what it deposits.
template <class T, class F, nephroid::Light L>
nephroid::Statistics walk_photons(const Scene<T, F>& scene, const L& light, int count) {
    const nephroid::HaltonSequence sequence(1);
    nephroid::Statistics statistics;
    for (int i = 0; i < count; ++i) {
        nephroid::Sampler sampler(sequence, static_cast<std::uint64_t>(i));
        const auto photon = light.emit(sampler, nephroid::Spread<T>{T(count), T(5)});
        if (const auto deposit = nephroid::walk(scene, photon, sampler, {}, statistics))
            statistics.end(Fate::splatted, nephroid::flux_traits<F>::power(deposit->flux));
    }
    return statistics;
}

} // namespace

TEST_CASE_TEMPLATE("scene: what a material does with a photon", T, float, double) {
    using V = Vec3<T>;
    ListSampler none;
    const V color(T(0.25), T(0.5), T(0.75));
    CHECK(bounce<T>(Colors<T>::diffuse(color), false, none).event == Event::diffuse);
    CHECK(bounce<T>(Colors<T>::diffuse(color), false, none).weight == color);
    CHECK(bounce<T>(Colors<T>::black(), false, none).event == Event::absorb);
    CHECK(bounce<T>(Colors<T>::emitter(color), false, none).event == Event::absorb);
    const auto mirrored = bounce<T>(Colors<T>::mirror(color), false, none);
    CHECK(mirrored.event == Event::reflect);
    CHECK(mirrored.weight == color);
    const auto gold = bounce<T>(Colors<T>::conductor(V(T(0.166)), V(T(3.15))), false, none);
    CHECK(gold.event == Event::reflect);
    CHECK(gold.weight == V(conductor_reflectance<T>(1, T(0.166), T(3.15))));
    CHECK(none.drawn == 0);
}

TEST_CASE_TEMPLATE("scene: glass reflects or refracts by one number against the reflectance", T, float, double) {
    const Colors<T> glass = Colors<T>::dielectric(1.5); // reflects 0.04 at normal incidence, either way
    for (const bool from_within : {false, true}) {
        ListSampler low{{0.039}}, high{{0.041}};
        const auto reflected = bounce<T>(glass, from_within, low);
        CHECK(reflected.event == Event::reflect);
        CHECK(reflected.weight == Vec3<T>(1));
        const auto refracted = bounce<T>(glass, from_within, high);
        CHECK(refracted.event == Event::refract);
        CHECK(refracted.weight == Vec3<T>(1));
        CHECK(refracted.eta == (from_within ? T(1.5) : T(1 / 1.5)));
        CHECK(refracted.medium.here() == (from_within ? Medium::none : 0));
        CHECK(low.drawn == 1);
        CHECK(high.drawn == 1);
    }
}

// The Abbe number is (n_d − 1)/(n_F − n_C), of the lines at 486.13, 587.56 and 656.27 nm. The extension's constants
// are rounded to six digits and to five, which are 10⁻⁵ of the difference.
TEST_CASE("material: dispersion is that of the Abbe number") {
    for (const double abbe : {20., 55., 90.}) {
        Material<float> glass = Material<float>::dielectric(1.6);
        CHECK(glass.index_at(450).value == 1.6);
        glass.dispersion = 20 / abbe;
        CHECK(glass.index_at(587.56).value == doctest::Approx(1.6).epsilon(1e-6));
        const double difference = glass.index_at(486.13).value - glass.index_at(656.27).value;
        CHECK(difference == doctest::Approx(0.6 / abbe).epsilon(2e-5));
        CHECK(glass.index_at(mean_light).value == 1.6);
        CHECK(glass.index_at(mean_light).slope == 0);
        const double slope = (glass.index_at(500.01).value - glass.index_at(499.99).value) / 0.02;
        CHECK(glass.index_at(500).slope == doctest::Approx(slope).epsilon(1e-6));
    }
    Material<float> air = Material<float>::dielectric(1.001);
    air.dispersion = 40; // more than there is: an index below 1 is none
    CHECK(air.index_at(2000).value == 1);
    CHECK(air.index_at(2000).slope == 0);
}

TEST_CASE("scene: a ratio of indices has the slope of its differences between glass and liquid") {
    Material<double> glass = Material<double>::dielectric(1.6, false),
                     liquid = Material<double>::dielectric(1.4, false);
    glass.dispersion = 0.8;
    liquid.dispersion = 0.4;
    const Vec3<double> up(0, 0, 1);
    Scene<double, double> scene({{Floor<double>(0), 0}, {Floor<double>(-5), 1}}, {glass, liquid});
    const auto hit = scene.intersect(Vec3<double>(0, 0, 1), -up, 0, 10);
    REQUIRE(hit);
    Medium outside;
    outside.enter(1, 0); // the liquid
    ListSampler none;
    for (const Medium& through : {Medium{}, outside}) {
        const auto eta = [&](double wavelength) { return scene.scatter_at(*hit, -up, none, through, wavelength).eta; };
        const auto at = scene.scatter_at(*hit, -up, none, through, 500);
        CHECK(at.eta < 1);
        CHECK(at.d_eta == doctest::Approx((eta(500.01) - eta(499.99)) / 0.02).epsilon(1e-6));
        CHECK(scene.scatter(*hit, -up, none, through).d_eta == 0);
    }
}

TEST_CASE_TEMPLATE("scene: no number is drawn where there is nothing to choose", T, float, double) {
    ListSampler none;
    const auto whole = bounce<T>(Colors<T>::dielectric(1.5, false), false, none);
    CHECK(whole.event == Event::refract);
    CHECK(whole.weight == Vec3<T>(1));
    const auto refracted = bounce<T>(Colors<T>::dielectric(1.5, true, Follow::refraction), false, none);
    CHECK(refracted.event == Event::refract);
    CHECK(std::abs(refracted.weight.x - T(0.96)) < 4 * std::numeric_limits<T>::epsilon());

    // Beyond the critical angle, from within: at 0.9 of the radius off the axis.
    for (const Follow follow : {Follow::both, Follow::refraction}) {
        const Scene<T> scene = one_sphere(Colors<T>::dielectric(1.5, true, follow));
        const auto hit = scene.intersect({T(0.9), 0, 0}, {0, 0, 1}, T(0), T(10));
        REQUIRE(hit.has_value());
        const auto total = scene.scatter(*hit, {0, 0, 1}, none);
        CHECK(total.event == (follow == Follow::both ? Event::reflect : Event::absorb));
        if (follow == Follow::both)
            CHECK(total.weight == Vec3<T>(1));
    }
    CHECK(none.drawn == 0);
}

// Straight down through a sheet of water onto the floor 2 below: (1 − R) exp(−2a) of each band arrives.
TEST_CASE_TEMPLATE("scene: a sheet of water over a floor absorbs by Beer's law on the way down", T, float, double) {
    using V = Vec3<T>;
    Colors<T> water = Colors<T>::dielectric(1.33, true, Follow::refraction);
    const V color(T(0.5), T(0.9), T(1));
    water.absorption = absorption_from<V>(color, 2); // after 2 world units just that color is left
    const Scene<T> scene({{TriangleMesh<T>(sheet<T>(5, 2, true, 1)), 0}, {Floor<T>(0), 0}},
                         {Colors<T>::diffuse(V(T(0.5))), water});
    nephroid::Photon<V, V> photon{{T(0.3), T(0.2), 4}, {0, 0, -1}, V(1), {}};
    ListSampler none;
    nephroid::Statistics statistics;
    const auto deposit = nephroid::walk(scene, photon, none, {}, statistics);
    REQUIRE(deposit.has_value());
    const T passed = T(1 - (0.33 / 2.33) * (0.33 / 2.33));
    for (int band = 0; band < 3; ++band)
        // Rays start off a surface by its position error, of up to 500 roundings, and so much of the way is missing.
        CHECK(std::abs(deposit->flux[band] - passed * color[band]) < 500 * std::numeric_limits<T>::epsilon());
    CHECK(deposit->normal == V(0, 0, 1));
}

TEST_CASE("scene: what is black after the attenuation distance is not undefined at none") {
    const auto absorption = absorption_from<Vec3<float>>({0.0f, 0.5f, 1.0f}, 3);
    CHECK(beer(absorption, 0.0f) == Vec3<float>(1));
    const auto left = beer(absorption, 3.0f);
    CHECK(left.x < 1e-20f);
    CHECK(std::abs(left.y - 0.5f) < 1e-6f);
    CHECK(left.z == 1);
    CHECK(std::abs(beer(absorption_from<double>(0.25, 2), 1.0) - 0.5) < 1e-15);
}

TEST_CASE_TEMPLATE("scene: the nearest of shapes of all kinds is hit and says what it is made of", T, float, double) {
    std::vector<typename Scene<T>::Part> parts;
    parts.push_back({Floor<T>(0), 0});
    parts.push_back({Sphere<T>({0, 0, 3}, T(0.5)), 1});
    parts.push_back({Disk<T>({0, 0, 2}, {0, 0, 1}, 1), 2});
    parts.push_back({Quad<T>({-1, -1, 1}, {2, 0, 0}, {0, 2, 0}), 3});
    parts.push_back({TriangleMesh<T>(sheet<T>(1, T(0.5), true, 4)), 0});
    const Scene<T> scene(std::move(parts), std::vector<Colors<T>>(5, Colors<T>::mirror(Vec3<T>(1))));
    const T heights[] = {T(0), T(2.5), T(2), T(1), T(0.5)}; // from below the sphere is hit first
    T from = -1;
    for (const std::size_t expected : {0u, 4u, 3u, 2u, 1u}) {
        const auto hit = scene.intersect({T(0.1), T(0.05), from}, {0, 0, 1}, T(0), T(100));
        REQUIRE(hit.has_value());
        CHECK(hit->surface == expected);
        CHECK(std::abs(hit->position.z - heights[expected]) < T(0.02));
        CHECK(scene.occluded({T(0.1), T(0.05), from}, {0, 0, 1}, T(0), hit->distance * T(1.001)));
        CHECK(!scene.occluded({T(0.1), T(0.05), from}, {0, 0, 1}, T(0), hit->distance * T(0.999)));
        from = hit->position.z + T(0.01);
    }
    CHECK(!scene.intersect({T(0.1), 0, 4}, {0, 0, 1}, T(0), std::numeric_limits<T>::infinity()));
}

TEST_CASE_TEMPLATE("scene: the bounds of what is specular hold it and nothing else", T, float, double) {
    const Scene<T> empty;
    CHECK(empty.empty());
    CHECK(!empty.has_specular());
    CHECK(!empty.specular_bounds());
    CHECK(!empty.intersect({0, 0, 0}, {0, 0, 1}, T(0), T(1)));

    const auto glass = Colors<T>::dielectric(1.5), wall = Colors<T>::diffuse(Vec3<T>(1));
    const Scene<T> scene({{Sphere<T>({1, 2, 3}, 1), 1}, {Sphere<T>({100, 0, 0}, 1), 0}, {Floor<T>(0), 0}},
                         {wall, glass});
    CHECK(scene.has_specular());
    const auto bounds = scene.specular_bounds();
    REQUIRE(bounds.has_value());
    CHECK(nephroid::length(Vec3<T>(bounds->centre - Vec3<T>(1, 2, 3))) < T(1e-5));
    CHECK(bounds->radius >= 1);
    CHECK(bounds->radius < T(1.74)); // of a cube about it, √3

    const Scene<T> mesh({{TriangleMesh<T>(sheet<T>(1, 2, true, 1)), 0}}, {wall, glass});
    CHECK(mesh.specular_points().size() == 4);
    const Scene<T> unbounded({{SineWave<T>({}), 1}}, {wall, glass});
    CHECK(unbounded.has_specular());
    CHECK(!unbounded.specular_bounds());
}

TEST_CASE("scene: materials that do not exist are refused") {
    CHECK_THROWS_AS(Scene<float>({{Floor<float>(0), 1}}, {Colors<float>::black()}), std::invalid_argument);
    CHECK_THROWS_AS(Scene<float>({{TriangleMesh<float>(sheet<float>(1, 0, true, 7)), 0}}, {Colors<float>::black()}),
                    std::invalid_argument);
    CHECK_THROWS_AS(static_cast<void>(Colors<float>::dielectric(0)), std::invalid_argument);
}

// All kinds of specular surfaces in a closed box, open to the top: the walk's account is in double, and what the scene
// answers must not create or lose flux.
TEST_CASE_TEMPLATE("scene: the flux of walks through glass and mirrors is accounted for", T, float, double) {
    using V = Vec3<T>;
    Colors<T> glass = Colors<T>::dielectric(1.5);
    glass.absorption = V(T(0.1), T(0.5), T(1));
    const Scene<T> scene({{Floor<T>(0), 0},
                          {TriangleMesh<T>(globe<T>(24, 0.1, V(0, 0, T(1.5)))), 0}, // of material 0: see below
                          {Sphere<T>({T(1.5), 0, 1}, T(0.7)), 1},
                          {Sphere<T>({T(-1.5), 0, 1}, T(0.7)), 2},
                          {Cylinder<T>({.radius = 3, .height = 3}), 3}},
                         {Colors<T>::diffuse(V(T(0.5))), glass, Colors<T>::conductor(V(T(0.2), T(0.9), T(1)), V(3)),
                          Colors<T>::mirror(V(T(0.9), T(0.8), T(0.7)))});
    const nephroid::StandardLights<V, V> light(
        {nephroid::PointLight<V, V>({.position = {0, T(0.5), 4}, .intensity = V(1, 2, 3)})});
    const auto account = walk_photons(scene, light, 20000);
    CHECK(account.emitted.photons == 20000);
    CHECK(std::abs(account.emitted.flux - account.accounted_flux()) < 1e-5 * account.emitted.flux);
    CHECK(std::abs(account.emitted.flux - light.power()) < 1e-3 * light.power());
    for (const Fate fate : {Fate::splatted, Fate::direct, Fate::absorbed, Fate::escaped})
        CHECK(account[fate].flux > 0);
    CHECK(account[Fate::invalid].flux < 1e-3 * account.emitted.flux);
}

// What is known of the cases in closed form or by quadrature (the project's mathematics, "The exact cases"): the flux
// on the floor. 4000 stratified photons find it to about a thousandth.
TEST_CASE_TEMPLATE("builtin cases: the light on the floor is what it should be", T, float, double) {
    const auto on_floor = [](std::string_view name, bool fresnel) {
        const auto c = builtin_case<T, T>(name, fresnel).value();
        const auto account = walk_photons(c.scene, c.light, 4000);
        CHECK(std::abs(account.emitted.flux - account.accounted_flux()) < 1e-5 * account.emitted.flux);
        CHECK(account[Fate::invalid].flux < 1e-3 * account.emitted.flux);
        return account[Fate::splatted].flux;
    };
    const double rounding = 1e-5; // 4000 fluxes in T
    CHECK(std::abs(on_floor("wave-focused", false) - 1) < rounding);
    CHECK(std::abs(on_floor("wave-prefocal", false) - 1) < rounding);
    CHECK(std::abs(on_floor("wave-focused", true) - 0.97957598) < 1e-4); // smooth
    CHECK(std::abs(on_floor("wave-prefocal", true) - 0.97993743) < 1e-4);
    CHECK(std::abs(on_floor("ring", false) - 1.428148) < 4e-3);
    CHECK(std::abs(on_floor("ring-zoom", false) - 1.428148) < 4e-3);
    // All light that enters the ball leaves it.
    const double ball = on_floor("ball", false), pi = 3.14159265358979;
    CHECK(ball < pi + rounding);
    CHECK(ball > 0.98 * pi);                                     // what comes out near the rim may fly off horizontally
    const double cone = 2 * pi * 16 * (1 - std::sqrt(15.0) / 4); // of the point light, seen from distance 4
    CHECK(std::abs(on_floor("ball-point", false) - cone) < 2e-3 * cone);
    CHECK(on_floor("ball-point", true) < 0.9 * cone);
    CHECK(!builtin_case<T>("teapot", false));
}

} // namespace nephroid::examples::scene_test
