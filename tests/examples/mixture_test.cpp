// SPDX-License-Identifier: MIT
/// @file  Surfaces that are several things at once: glass that transmits in part, windows, and what is there in part.
#include "common/direct_light.hpp"
#include "common/eye_paths.hpp"
#include "common/lamps.hpp"
#include "examples/worlds.hpp"
#include "support/is_sanitized.hpp"

#include "nephroid/execution/executor.hpp"
#include "nephroid/sequence/halton.hpp"
#include "nephroid/transport/walk.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

namespace nephroid::examples::mixture_test {

using nephroid::Event;
using nephroid::HaltonSequence;
using nephroid::examples::testing::ListSampler;
using nephroid::examples::testing::sheet;

namespace {

using V = Vec3<double>;
using M = Material<double>;
using S = Scene<double, double>;

/// Fresnel's reflectance of glass, by the angle from the normal in air, as every textbook has it.
double fresnel(double angle, double n) {
    if (angle < 1e-6)
        return std::pow((n - 1) / (n + 1), 2);
    const double inner = std::asin(std::sin(angle) / n);
    return 0.5 * (std::pow(std::sin(angle - inner) / std::sin(angle + inner), 2) +
                  std::pow(std::tan(angle - inner) / std::tan(angle + inner), 2));
}

/// A table at z = 0, and over it sheets of glass, each facing up or down.
struct Sheet {
    double height;
    bool up;
};
S table_under(const std::vector<Sheet>& sheets, const M& glass) {
    std::vector<S::Part> parts{{TriangleMesh<double>(sheet<double>(50, 0)), 0}};
    for (const Sheet& s : sheets)
        parts.push_back({TriangleMesh<double>(sheet<double>(50, s.height, s.up, 1)), 1});
    return S(std::move(parts), {M::diffuse(0.8), glass});
}

/// What photons from one point and direction leave on the table: where, and how much of the light.
struct Landed {
    double flux = 0, x_mean = 0;
};
constexpr std::uint64_t count = tests::is_sanitized ? 10'000 : 200'000;
Landed land(const S& scene, double angle) {
    Landed landed;
    const V direction(std::sin(angle), 0, -std::cos(angle));
    nephroid::Statistics account;
    double deposited = 0; // whoever splats it would book it
    const HaltonSequence halton;
    for (std::uint64_t i = 0; i < count; ++i) {
        nephroid::Sampler<HaltonSequence> sampler(halton, i);
        const nephroid::Photon<V, double> photon{V(0, 0, 5), direction, 1.0 / double(count), {}};
        if (const auto deposit = walk(scene, photon, sampler, nephroid::WalkLimits{}, account)) {
            deposited += deposit->flux;
            if (std::abs(deposit->position.z) < 1e-9) {
                landed.flux += deposit->flux;
                landed.x_mean += deposit->flux * deposit->position.x;
            }
        }
    }
    landed.x_mean /= landed.flux;
    CHECK(std::abs(account.emitted.flux - (account.accounted_flux() + deposited)) < 1e-9);
    return landed;
}

/// Five standard errors of a share of so many independent photons; Halton's are better.
double statistics(double share) { return 5 * std::sqrt(share * (1 - share) / double(count)); }

} // namespace

// Of what meets a face 1 - R enters, and of that the share t passes. Between two faces the light goes there and back:
// ((1 - R) t)^2 (1 + R^2 + R^4 ...).
TEST_CASE("mixtures: a slab that transmits the share t lets t squared of a clear one's light through") {
    for (const double t : {0.1, 0.3, 0.6, 0.9, 1.0})
        for (const double angle : {0.0, 0.7}) {
            M glass = M::dielectric(1.5);
            glass.transmission = t;
            const double r = fresnel(angle, 1.5), expected = std::pow((1 - r) * t, 2) / (1 - r * r);
            const Landed landed = land(table_under({{2, true}, {1, false}}, glass), angle);
            CAPTURE(t);
            CAPTURE(angle);
            CHECK(std::abs(landed.flux - expected) < statistics(expected));
        }
}

// A thin pane: both its faces, with all that goes there and back between them, (1 - R) / (1 + R); nothing is displaced.
TEST_CASE("mixtures: a window of one sheet passes light straight on, from either side") {
    for (const bool up : {true, false})
        for (const double angle : {0.0, std::numbers::pi / 4, 1.2}) {
            const double r = fresnel(angle, 1.5), expected = (1 - r) / (1 + r);
            const Landed landed = land(table_under({{1, up}}, M::window(1.5)), angle);
            CHECK(std::abs(landed.flux - expected) < statistics(expected));
            CHECK(std::abs(landed.x_mean - 5 * std::tan(angle)) < 1e-9);
        }
}

TEST_CASE("mixtures: what is there in part lets the rest of the light pass unbent") {
    for (const double coverage : {0.0, 0.25, 0.8}) {
        M veil = M::diffuse(1);
        veil.coverage = coverage;
        const Landed landed = land(table_under({{1, true}, {2, false}}, veil), 0.5);
        const double expected = std::pow(1 - coverage, 2);
        CHECK(std::abs(landed.flux - expected) <= statistics(expected) + 1e-9);
        CHECK(std::abs(landed.x_mean - 5 * std::tan(0.5)) < 1e-9);
    }
}

TEST_CASE("mixtures: shares of a surface add up, and each number takes the way that its share says") {
    M glass = M::dielectric(1.5);
    glass.transmission = 0.6;
    glass.coverage = 0.75;
    const S scene = table_under({{1, true}}, glass);
    const auto hit = scene.intersect({0, 0, 2}, {0, 0, -1}, 0, 10).value();
    const auto share = scene.shares(glass, hit, {0, 0, -1});
    CHECK(share.missed == doctest::Approx(0.25));
    CHECK(share.reflected == doctest::Approx(0.75 * 0.04));
    CHECK(share.passed == doctest::Approx(0.75 * 0.96 * 0.6));
    const auto event = [&](double number) {
        ListSampler numbers{{number}};
        return scene.scatter(hit, {0, 0, -1}, numbers);
    };
    CHECK(event(0.249).event == Event::refract);
    CHECK(event(0.249).eta == 1);
    CHECK(event(0.251).event == Event::reflect);
    CHECK(event(0.279).event == Event::reflect);
    CHECK(event(0.281).event == Event::refract);
    CHECK(event(0.281).eta == doctest::Approx(1 / 1.5));
    CHECK(event(0.711).event == Event::refract);
    CHECK(event(0.713).event == Event::diffuse);
    CHECK(event(0.999999).event == Event::diffuse);
}

// Light on a surface that is diffuse by the share d: photons that choose that part by chance leave d of the flux, and
// the direct light is multiplied by it. What the eye sees of either is the same.
TEST_CASE("mixtures: the diffuse part is as bright by direct light as by the photons that find it") {
    M veil = M::diffuse(0.8);
    veil.coverage = 0.25;
    const S scene = table_under({{1, true}}, veil);
    const Camera<double> camera =
        Camera<double>::orthographic({{0, 0, 3}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}}, 1.0, 2, 2);
    nephroid::SerialExecutor serial;
    const auto eye = trace_eye_paths(scene, camera, {}, serial);
    REQUIRE(eye.vertices.size() == 8); // the veil and, through it, the table, of four pixels
    for (const auto& vertex : eye.vertices) {
        const bool on_veil = vertex.position.z > 0.5;
        // Seen whole, lit by a quarter; and through the three quarters that are not there.
        CHECK(vertex.weight == doctest::Approx((on_veil ? 1 : 0.75) * 0.8 / std::numbers::pi));
        CHECK(vertex.diffuse_share == doctest::Approx(on_veil ? 0.25 : 1));
    }
    Lamps<double, double> lamps;
    lamps.lamps.push_back({Lamp<double, double>::Kind::directional, {}, {0, 0, -1}, 1.0});
    const auto picture = direct_layer(scene, lamps, eye, {}, serial);
    CHECK(picture[0] == doctest::Approx(0.25 * 0.8 / std::numbers::pi)); // the table gets its light as a caustic
}

} // namespace nephroid::examples::mixture_test
