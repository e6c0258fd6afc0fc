// SPDX-License-Identifier: MIT
#include "common/direct_light.hpp"

#include "common/photon_lights.hpp"
#include "examples/worlds.hpp"

#include "nephroid/execution/thread_executor.hpp"
#include "nephroid/sequence/halton.hpp"
#include "nephroid/transport/walk.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

namespace nephroid::examples::direct_light_test {

using namespace nephroid::examples::testing;

namespace {

template <class T>
using Colors = Material<Vec3<T>>;

/// A point of a floor at height 0.
template <class T>
EyeVertex<T, Vec3<T>> on_floor(T x, T y) {
    return {{x, y, 0}, {0, 0, 1}, {0, 0, 1}, std::numeric_limits<T>::epsilon() * 4 * (std::abs(x) + std::abs(y)),
            0,         Vec3<T>(1)};
}

template <class T>
Scene<T> floor_and(std::vector<typename Scene<T>::Part> parts, const Colors<T>& material) {
    parts.push_back({Floor<T>(0), 0});
    return Scene<T>(std::move(parts), {Colors<T>::diffuse(Vec3<T>(1)), material});
}

} // namespace

// I cos / r² = I h / r³.
TEST_CASE_TEMPLATE("direct light: a point lamp lights a floor by the inverse square and the cosine", T, float, double) {
    const Scene<T> scene = floor_and<T>({}, Colors<T>::black());
    Lamps<T, Vec3<T>> lamps;
    lamps.lamps.push_back({.position = {T(0.5), T(-1), 2}, .intensity = {1, 2, 3}});
    const DirectLight<T, Vec3<T>> light(scene, lamps, {});
    for (const auto& [x, y] : {std::pair<T, T>{T(0.5), -1}, {0, 0}, {3, 2}}) {
        const T r2 = (x - T(0.5)) * (x - T(0.5)) + (y + 1) * (y + 1) + 4, expected = 2 / (r2 * std::sqrt(r2));
        const Vec3<T> found = light.irradiance(on_floor(x, y), 0);
        for (int band = 0; band < 3; ++band)
            CHECK(std::abs(found[band] - expected * T(band + 1)) <
                  16 * std::numeric_limits<T>::epsilon() * expected * 3);
    }
    auto below = on_floor<T>(0, 0);
    below.normal = below.shading_normal = {0, 0, -1};
    CHECK(light.irradiance(below, 0) == Vec3<T>(0));
}

TEST_CASE_TEMPLATE("direct light: a directional lamp lights a floor by the cosine and casts shadows", T, float,
                   double) {
    const T c = T(0.6), s = T(0.8);
    const Scene<T> scene = floor_and<T>({{Sphere<T>({3, 0, 4}, T(0.5)), 1}}, Colors<T>::dielectric(1.5));
    Lamps<T, Vec3<T>> lamps;
    using Kind = typename Lamp<T, Vec3<T>>::Kind;
    lamps.lamps.push_back({.kind = Kind::directional, .direction = {-c, 0, -s}, .intensity = Vec3<T>(2)});
    const DirectLight<T, Vec3<T>> light(scene, lamps, {});
    CHECK(std::abs(light.irradiance(on_floor<T>(5, 0), 0).x - 2 * s) < 8 * std::numeric_limits<T>::epsilon());
    CHECK(light.irradiance(on_floor<T>(0, 0), 0).x == 0);      // behind the ball: glass blocks as well
    CHECK(light.irradiance(on_floor<T>(T(0.63), 0), 0).x > 0); // its shadow reaches 0.5 / 0.8 = 0.625 along x
    CHECK(light.irradiance(on_floor<T>(T(0.62), 0), 0).x == 0);
}

TEST_CASE_TEMPLATE("direct light: a spot lamp falls off between its cones as glTF says", T, float, double) {
    const Scene<T> scene = floor_and<T>({}, Colors<T>::black());
    Lamps<T, Vec3<T>> lamps;
    using Kind = typename Lamp<T, Vec3<T>>::Kind;
    const T inner = std::cos(T(0.2)), outer = std::cos(T(0.6));
    lamps.lamps.push_back({.kind = Kind::spot,
                           .position = {0, 0, 1},
                           .direction = {0, 0, -1},
                           .intensity = Vec3<T>(1),
                           .cos_inner = inner,
                           .cos_outer = outer});
    const DirectLight<T, Vec3<T>> light(scene, lamps, {});
    for (const T angle : {T(0), T(0.19), T(0.3), T(0.5), T(0.61)}) {
        const T c = std::cos(angle), share = (c - outer) / (inner - outer);
        const T falloff = angle < T(0.2) ? T(1) : angle < T(0.6) ? share * share : T(0);
        const T expected = falloff * c * c * c; // E = I cos / r², r = 1 / cos
        CHECK(std::abs(light.irradiance(on_floor<T>(std::tan(angle), 0), 0).x - expected) <
              64 * std::numeric_limits<T>::epsilon());
    }
}

TEST_CASE_TEMPLATE("direct light: a lamp behind a wall does not light", T, float, double) {
    const Scene<T> scene = floor_and<T>({{TriangleMesh<T>(sheet<T>(1, 1, true, 1)), 0}}, Colors<T>::black());
    Lamps<T, Vec3<T>> lamps;
    lamps.lamps.push_back({.position = {0, 0, 2}, .intensity = Vec3<T>(1)});
    const DirectLight<T, Vec3<T>> light(scene, lamps, {});
    CHECK(light.irradiance(on_floor<T>(T(1.9), 0), 0).x == 0); // the shadow is twice the sheet
    CHECK(light.irradiance(on_floor<T>(T(2.1), 0), 0).x > 0);
    lamps.lamps[0].position.z = T(0.5); // now below it
    CHECK(light.irradiance(on_floor<T>(T(0.3), 0), 0).x > 0);
}

// Oracle: the integral of L cos cos' / r² over the quad by 200 × 200 midpoints. With n stratified rays the error is
// about 1/n of the integrand's variation; the mean of 64 vertices with 64 rays each is good to a thousandth.
TEST_CASE_TEMPLATE("direct light: a quad lights a floor as the quadrature over it says", T, float, double) {
    const Vec3<T> radiance(2, 1, T(0.5));
    const Scene<T> scene =
        floor_and<T>({{TriangleMesh<T>(sheet<T>(1, T(1.5), false, 1)), 0}}, Colors<T>::emitter(radiance));
    const Lamps<T, Vec3<T>> lamps{{}, area_lamps(scene)};
    REQUIRE(lamps.areas.size() == 1);
    CHECK(lamps.areas[0].triangles.size() == 2);
    const DirectLight<T, Vec3<T>> light(scene, lamps, {.shadow_rays = 64});
    for (const double x : {0.0, 0.8, 2.5}) {
        double expected = 0;
        constexpr int n = 200;
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                const double dx = (i + 0.5) * 2 / n - 1 - x, dy = (j + 0.5) * 2 / n - 1;
                const double r2 = dx * dx + dy * dy + 2.25;
                expected += 2.25 / (r2 * r2) * 4 / (n * n);
            }
        Vec3<double> mean(0);
        for (std::uint64_t i = 0; i < 64; ++i)
            mean += Vec3<double>(light.irradiance(on_floor(T(x), T(0)), i)) / 64.0;
        CHECK(std::abs(mean.x - 2 * expected) < 1e-3 * 2 * expected);
        CHECK(std::abs(mean.z - 0.5 * expected) < 1e-3 * 0.5 * expected);
    }
    auto above = on_floor<T>(0, 0); // the dark side
    above.position.z = 3;
    above.normal = above.shading_normal = {0, 0, -1};
    CHECK(light.irradiance(above, 0) == Vec3<T>(0));
}

TEST_CASE_TEMPLATE("direct light: the layer adds what emitters show and what vertices reflect", T, float, double) {
    const Vec3<T> radiance(3, 2, 1);
    const Scene<T> scene({{Floor<T>(0), 0}, {TriangleMesh<T>(sheet<T>(T(0.5), 1, true, 1)), 0}},
                         {Colors<T>::diffuse(Vec3<T>(T(0.5))), Colors<T>::emitter(radiance)});
    Lamps<T, Vec3<T>> lamps{{}, area_lamps(scene)};
    using Kind = typename Lamp<T, Vec3<T>>::Kind;
    lamps.lamps.push_back({.kind = Kind::directional, .direction = {0, 0, -1}, .intensity = Vec3<T>(4)});
    // Four pixels of side 1 about (0, 0): the emitter covers a quarter of each; it shines upwards.
    const auto camera = Camera<T>::orthographic({{0, 0, 2}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}}, T(1), 2, 2);
    const auto eye = trace_eye_paths(scene, camera, {.samples = 16}, nephroid::SerialExecutor{});
    const auto layer = direct_layer(scene, lamps, eye, {}, nephroid::SerialExecutor{});
    REQUIRE(layer.size() == 4);
    for (const Vec3<T>& pixel : layer)
        for (int band = 0; band < 3; ++band) {
            const T expected = radiance[band] / 4 + T(0.75 * 4 * 0.5 / std::numbers::pi);
            CHECK(std::abs(pixel[band] - expected) < 64 * std::numeric_limits<T>::epsilon());
        }
    const auto threaded = direct_layer(scene, lamps, eye, {}, nephroid::ThreadExecutor(3));
    CHECK(threaded == layer);
}

// The lamps' photons: what starts on an emitter does not hit it, and what stands in a beam casts its shadow.
TEST_CASE_TEMPLATE("lamps: photons leave their emitter and start in front of all that may cast shadows", T, float,
                   double) {
    using V = Vec3<T>;
    const auto walk_all = [](const Scene<T>& scene, const Lamps<T, V>& lamps) {
        const auto lights = photon_lights(lamps, scene);
        const nephroid::HaltonSequence sequence(2);
        nephroid::Statistics statistics;
        for (std::uint64_t i = 0; i < 2000; ++i) {
            nephroid::Sampler sampler(sequence, i);
            const auto photon = lights.emit(sampler, nephroid::Spread<T>{T(2000), T(5)});
            if (const auto deposit = nephroid::walk(scene, photon, sampler, {}, statistics))
                statistics.end(nephroid::Fate::splatted, nephroid::flux_traits<V>::power(deposit->flux));
        }
        CHECK(std::abs(statistics.emitted.flux - statistics.accounted_flux()) < 1e-5 * statistics.emitted.flux);
        return statistics;
    };
    const std::vector<Colors<T>> materials{Colors<T>::diffuse(V(1)), Colors<T>::dielectric(1.5, false),
                                           Colors<T>::emitter(V(1), true)};
    // A sheet that shines on both sides above a ball: nothing but the ball and the floor is met.
    const Scene<T> lit(
        {{Floor<T>(0), 0}, {Sphere<T>({0, 0, 2}, 1), 1}, {TriangleMesh<T>(sheet<T>(T(0.5), 6, false, 2)), 0}},
        materials);
    const auto account = walk_all(lit, {{}, area_lamps(lit)});
    CHECK(account[nephroid::Fate::absorbed].photons == 0);
    CHECK(account[nephroid::Fate::splatted].flux > 0.3 * account.emitted.flux);

    // A roof over the ball keeps all of the sun from it.
    using Kind = typename Lamp<T, V>::Kind;
    Lamps<T, V> sun;
    sun.lamps.push_back({.kind = Kind::directional, .direction = nephroid::normalize(V(T(0.1), T(0.2), -1))});
    const Scene<T> roofed(
        {{Floor<T>(0), 0}, {Sphere<T>({0, 0, 2}, 1), 1}, {TriangleMesh<T>(sheet<T>(4, 6, true, 0)), 0}}, materials);
    CHECK(walk_all(roofed, sun)[nephroid::Fate::direct].photons == 2000);

    CHECK_THROWS_AS(static_cast<void>(photon_lights(Lamps<T, V>{}, lit)), std::invalid_argument);
    const Scene<T> matt({{Floor<T>(0), 0}}, materials);
    CHECK_THROWS_AS(static_cast<void>(photon_lights(sun, matt)), std::invalid_argument);
}

} // namespace nephroid::examples::direct_light_test
