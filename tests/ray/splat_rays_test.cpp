// SPDX-License-Identifier: MIT
#include "nephroid/ray/splat_rays.hpp"

#include "nephroid/emission/light/point.hpp"
#include "nephroid/execution/thread_executor.hpp"
#include "nephroid/sequence/halton.hpp"

#include "ray/uniform_field.hpp"
#include "support/message_of.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

namespace nephroid::tests::splat_rays_test {

using V = glm::vec3;
using Vertices = std::vector<RoomVertex<float>>;

namespace {

const auto fixed = Rays{}.with_filter(NoPixelFilter{}).with_width(FixedRayWidth{0.1});

/// A wall that only takes light.
[[nodiscard]] Wall<float, float> black(const V& corner, const V& u, const V& v) {
    return {corner, u, v, 0.0f, Event::deposit};
}

/// The floor z = 0 about the origin, and vertices all over its middle.
[[nodiscard]] Room<float> floor_without_end() { return {{black({-3, -3, 0}, {6, 0, 0}, {0, 6, 0})}}; }
[[nodiscard]] Vertices middle_of_floor() {
    Vertices all;
    for (int i = 0; i < 100; ++i)
        all.push_back({V(float(i % 10) / 9 - 0.5f, float(i / 10) / 9 - 0.5f, 0), V(0, 0, 1)});
    return all;
}

template <class S, class L, class... Arguments>
[[nodiscard]] std::vector<float> picture(const S& scene, const L& lamp, const Vertices& vertices,
                                         const PhotonPass& pass, Arguments&&... arguments) {
    const auto map = map_of(vertices);
    auto sums = nephroid::sums<float>(map);
    splat_rays(scene, lamp, sums, pass, arguments...);
    std::vector<float> all(vertices.size());
    sums.for_each([&](std::size_t vertex, float e) { all[vertex] = e; });
    return all;
}

} // namespace

// The share of N = 200,000 flights that pass the unit square of 2.6 projected square units of the field's sphere is
// about 0.1, two thirds of the variance of as many points: 0.011 over the mean of all; three of these.
// The paper's half ball loses ½ − c(3 − c²)/4 of a kernel at the cosine c, which over even light is 1/10 for the
// Epanechnikov kernel and 1/14 for the biweight: of the same flights, relative to those of the plane. What is lost of
// one flight varies by about its mean, so that of 20,000 flights over the patch 0.1/√20,000 are left, seven times.
TEST_CASE("rays: on an open plane no light is lost, and of the paper's half ball a tenth is") {
    const UniformField<float> field{{0, 0, 0}, 0.9};
    const auto vertices = middle_of_floor();
    const auto of = [&](const auto& policies) {
        return mean_irradiance(floor_without_end(), field, vertices, 200'000, policies);
    };
    const auto epanechnikov = fixed.with_kernel(EpanechnikovKernel{});
    const double plane = of(epanechnikov), smooth = of(fixed);
    CHECK(std::abs(plane - 1) < 0.033);
    CHECK(std::abs(smooth - 1) < 0.033);
    CHECK(std::abs(of(epanechnikov.with_ends(EndAtPlaneOrBall{})) / plane - 1) < 1e-4);
    CHECK(std::abs(of(epanechnikov.with_ends(EndAtHalfBall{})) / plane - (1 - 1.0 / 10)) < 0.005);
    CHECK(std::abs(of(fixed.with_ends(EndAtHalfBall{})) / smooth - (1 - 1.0 / 14)) < 0.005);
}

// Points are low by a half and three quarters there. Noise of one place: 4π R² N⁻¹ / (π h²) = 0.0045 per flight
// and cosine, so that a hundred thousand flights give 0.03 at four independent places.
TEST_CASE("rays: edges and corners get all of the light") {
    const Room<float> square{{black({-0.5f, -0.5f, 0}, {1, 0, 0}, {0, 1, 0})}};
    const UniformField<float> field{{0, 0, 0}, 0.85};
    CHECK(std::abs(mean_irradiance(square, field, row<float>({0.4999f, -0.4f, 0}, {0.4999f, 0.4f, 0}, {0, 0, 1}),
                                   100'000, fixed) -
                   1) < 0.09);
    Vertices corners;
    for (int i = 0; i < 4; ++i)
        corners.push_back({V(i % 2 == 0 ? -0.4999f : 0.4999f, i / 2 == 0 ? -0.4999f : 0.4999f, 0), V(0, 0, 1)});
    CHECK(std::abs(mean_irradiance(square, field, corners, 100'000, fixed) - 1) < 0.09);
    // A cube, from outside: the ball keeps what flights to its sides lose.
    Room<float> cube{box_walls<float, float>(0.0f)};
    for (Wall<float, float>& wall : cube.walls)
        wall = black(wall.corner, wall.v, wall.u);
    const UniformField<float> around{{0.5f, 0.5f, 0.5f}, 1.0};
    CHECK(std::abs(mean_irradiance(cube, around, row<float>({0.1f, 1e-4f, 1}, {0.9f, 1e-4f, 1}, {0, 0, 1}), 100'000,
                                   fixed.with_ends(EndAtPlaneOrBall{})) -
                   1) < 0.09);
}

// The sheet has no thickness and the vertices lie on it, so that they are in the plane that light leaves, to rounding.
TEST_CASE("rays: light that leaves one side of a sheet does not reach the other") {
    const V n = normalize(V(1, 2, 3)), u = normalize(cross(n, V(1, 0, 0))), v = cross(n, u),
            corner(0.37f, -0.2f, 0.11f);
    const Room<float> sheet{{{corner, u, v, 0.9f}}};
    Vertices lower, upper;
    for (int i = 0; i < 64; ++i) {
        const V place = corner + (float(i % 8) + 0.5f) / 8 * u + (float(i / 8) + 0.5f) / 8 * v;
        lower.push_back({place, -n});
        upper.push_back({place + 0.02f * n, -n}); // these look down onto it
    }
    const PointLight<V, float> lamp({corner + 0.5f * u + 0.5f * v + 0.8f * n, 1.0f});
    const auto light_of = [&](const Vertices& vertices) {
        double sum = 0;
        for (const float e : picture(sheet, lamp, vertices, {.count = 5000, .smoothing = 10}, fixed))
            sum += double(e);
        return sum;
    };
    CHECK(light_of(lower) == 0);
    CHECK(light_of(upper) > 10);
}

// A plate 0.2h above the floor leaves a point in its middle 1/(1 + (1/0.02)²) and less: 0.002 with half sides of 0.5.
TEST_CASE("rays: under a plate it is dark if short rays say what stands between") {
    Room<float> room = floor_without_end();
    room.walls.push_back(black({-0.5f, -0.5f, 0.02f}, {1, 0, 0}, {0, 1, 0}));
    const UniformField<float> field{{0, 0, 0}, 0.9};
    const auto vertices = row<float>({-0.1f, -0.1f, 0}, {0.1f, 0.1f, 0}, {0, 0, 1}, 16);
    const auto both = fixed.with_ends(EndAtPlaneOrBall{});
    CHECK(mean_irradiance(room, field, vertices, 40'000, both) > 0.5); // shines through
    CHECK(std::abs(mean_irradiance(room, field, vertices, 40'000, both.with_visibility(ShortRays{})) - 0.002) < 0.005);
}

// ½(1 − D/√(…)) by Lambert's formula: 0.47650048 at 0.03 from a unit wall that emits, and 0.42254486 at 0.1.
// One radius of 0.1 loses 0.36 there at 0.03. Noise: clipped beams there are 0.02 to 0.04 wide.
TEST_CASE("rays: beside a wall that emits, a clipped beam has the wall's light") {
    Room<float> cube{box_walls<float, float>(0.0f)};
    for (Wall<float, float>& wall : cube.walls)
        wall.event = Event::deposit;
    const auto lamp = cube.glow(1.0f, {0});
    const auto at = [&](float distance, const auto& policies) {
        return mean_irradiance(cube, lamp, row<float>({distance, 0, 0.45f}, {distance, 0, 0.55f}, {0, 1, 0}), 200'000,
                               policies);
    };
    const auto clipped = fixed.with_border(ClipAtEmitter{0.01});
    CHECK(std::abs(at(0.03f, clipped) / 0.47650048 - 1) < 0.05);
    CHECK(std::abs(at(0.1f, clipped) / 0.42254486 - 1) < 0.05);
    CHECK(std::abs(at(0.03f, fixed.with_kernel(EpanechnikovKernel{})) / 0.47650048 - (1 - 0.36)) < 0.06);
}

// I cos/d² of a point lamp above the square's middle. A beam's own width makes it low by r1²/4, 0.002 at s = 16.
TEST_CASE("rays: a table's edge and corner under a point lamp are as bright as they are") {
    const Room<float> table{{black({-0.5f, -0.5f, 0}, {1, 0, 0}, {0, 1, 0})}};
    const PointLight<V, float> lamp({.position = {0, 0, 1}, .intensity = 1.0f, .target = {{{0, 0, 0}, 0.8f}}});
    Vertices edge = row<float>({0.4999f, -0.3f, 0}, {0.4999f, 0.3f, 0}, {0, 0, 1}), corners;
    for (int i = 0; i < 4; ++i)
        corners.push_back({V(i % 2 == 0 ? -0.4999f : 0.4999f, i / 2 == 0 ? -0.4999f : 0.4999f, 0), V(0, 0, 1)});
    for (const Vertices& vertices : {edge, corners}) {
        const auto found =
            picture(table, lamp, vertices, {.count = 20'000, .smoothing = 16}, Rays{}.with_filter(NoPixelFilter{}));
        double error = 0;
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            const double d2 = 1 + double(dot(vertices[i].position, vertices[i].position));
            error += double(found[i]) * d2 * std::sqrt(d2) - 1;
        }
        CHECK(std::abs(error / double(vertices.size())) < 0.01);
    }
}

// M/(1 − ρ) = 1 everywhere in a furnace, direct light included; away from its corners by own widths. 20,000 photons
// have 40,000 flights, of which 1,700 land on the patch, with √2 for the bounces that belong together: 0.035.
TEST_CASE("rays: in a furnace all bounces add up to the same light everywhere but in its edges") {
    const Room<float> room = furnace<float>();
    const auto lamp = room.glow(0.5f, {0, 1, 2, 3, 4, 5});
    Vertices vertices;
    for (int i = 0; i < 64; ++i)
        vertices.push_back({V(0.25f + 0.5f * float(i % 8) / 7, 0, 0.25f + 0.5f * float(i / 8) / 7), V(0, 1, 0)});
    const auto found = picture(room, lamp, vertices, {.count = 20'000, .smoothing = 10},
                               Rays{}.with_width(DifferentialWidth{.start = 0.02}).with_filter(NoPixelFilter{}));
    double sum = 0;
    for (const float e : found)
        sum += double(e);
    CHECK(std::abs(sum / 64 - 1) < 0.07);
    const auto indirect = picture(room, lamp, vertices, {.count = 20'000, .smoothing = 10},
                                  Rays{}
                                      .with_width(DifferentialWidth{.start = 0.02})
                                      .with_filter(NoPixelFilter{})
                                      .with_flights(IndirectFlights{}));
    sum = 0;
    for (const float e : indirect)
        sum += double(e);
    CHECK(std::abs(sum / 64 - 0.5) < 0.05);
}

TEST_CASE("rays: any number of threads makes the same picture, bit for bit, and so do parts of a pass") {
    const Room<float> room = furnace<float>();
    const auto lamp = room.glow(0.5f, {0, 1, 2, 3, 4, 5});
    const auto vertices = room.vertices(10, {0, 1, 2, 3, 4, 5});
    ThreadExecutor threads(2);
    const PhotonPass pass{.count = 1000};
    const auto one = picture(room, lamp, vertices, pass), two = picture(room, lamp, vertices, pass, threads);
    CHECK(one == two);

    const auto map = map_of(vertices);
    auto sums = nephroid::sums<float>(map);
    const auto first = splat_rays(room, lamp, sums, {.first = 0, .count = 600, .total = 1000});
    const auto second = splat_rays(room, lamp, sums, {.first = 600, .count = 400, .total = 1000});
    CHECK(first.is_smoothing_chosen);
    CHECK(first.smoothing == second.smoothing); // of one pilot
    sums.for_each([&](std::size_t vertex, float e) { CHECK(e == doctest::Approx(one[vertex]).epsilon(1e-4)); });
}

TEST_CASE("rays: all flux and all flights are accounted for") {
    const Room<float> room = furnace<float>();
    const auto lamp = room.glow(0.5f, {0, 1, 2, 3, 4, 5});
    const auto vertices = room.vertices(6, {2});
    const auto map = map_of(vertices);
    auto sums = nephroid::sums<float>(map);
    const auto all = splat_rays(room, lamp, sums, {.count = 2000, .smoothing = 10});
    CHECK(std::abs(all.statistics.accounted_flux() / all.statistics.emitted.flux - 1) < 1e-9);
    std::uint64_t flights = 0;
    for (const Tally& tally : all.flights.fates)
        flights += tally.photons;
    CHECK(flights == 2000 + all.statistics.diffuse_bounces);
    CHECK(all.flights[Fate::splatted].photons > 100);
    CHECK(all.flights[Fate::unseen].photons > 100);
    const auto later =
        splat_rays(room, lamp, sums, {.count = 2000, .smoothing = 10}, Rays{}.with_flights(IndirectFlights{}));
    flights = 0;
    for (const Tally& tally : later.flights.fates)
        flights += tally.photons;
    CHECK(flights == later.statistics.diffuse_bounces);
    const auto none = splat_rays(room, lamp, sums, {.count = 200}, Rays{}.with_flights(CausticFlights{}));
    CHECK(none.flights[Fate::splatted].photons == 0);
    CHECK(none.statistics.rays == 200); // no photon is followed any further
}

TEST_CASE("rays: a response makes radiance of the flights' directions") {
    const Room<float> room = furnace<float>();
    const auto lamp = room.glow(0.5f, {0, 1, 2, 3, 4, 5});
    const auto vertices = room.vertices(8, {2});
    const auto map = map_of(vertices);
    auto plain = nephroid::sums<float>(map);
    auto twice = nephroid::sums<float>(map, [](std::size_t, const V& d) { return d.y < 0 ? 2.0f : 100.0f; });
    splat_rays(room, lamp, plain, {.count = 500, .smoothing = 20});
    splat_rays(room, lamp, twice, {.count = 500, .smoothing = 20});
    std::vector<float> expected(vertices.size());
    plain.for_each([&](std::size_t vertex, float e) { expected[vertex] = e; });
    auto in_double = nephroid::sums<float>(map, InDouble{});
    splat_rays(room, lamp, in_double, {.count = 500, .smoothing = 20});
    in_double.for_each(
        [&](std::size_t vertex, float e) { CHECK(e == doctest::Approx(expected[vertex]).epsilon(1e-4)); });
    twice.for_each(
        [&](std::size_t vertex, float e) { CHECK(e == doctest::Approx(2 * expected[vertex]).epsilon(1e-4)); });
}

TEST_CASE("rays: what cannot be is refused with a sentence, and an empty receiver is no error") {
    const Room<float> room = furnace<float>();
    const auto lamp = room.glow(0.5f, {2});
    const auto vertices = room.vertices(4, {2});
    const auto map = map_of(vertices), empty = map_of(Vertices{});
    auto sums = nephroid::sums<float>(map), none = nephroid::sums<float>(empty);
    const auto refusal = [&](const PhotonPass& pass, const auto& policies) {
        return message_of([&] { splat_rays(room, lamp, sums, pass, policies); });
    };
    CHECK(refusal({.count = 0}, Rays{}).find("splat_rays: zero photons") != std::string::npos);
    CHECK(refusal({.count = 9, .smoothing = -1}, Rays{}).find("smoothing is -1") != std::string::npos);
    CHECK(refusal({.count = 9}, Rays{.reach_behind = 0}).find("reach_behind is 0") != std::string::npos);
    CHECK(refusal({.count = 9}, Rays{}.with_width(FixedRayWidth{-2})).find("radius is -2") != std::string::npos);
    CHECK(refusal({.count = 9}, Rays{}.with_width(FixedRayCone{-1, 1})).find("start is -1") != std::string::npos);
    CHECK(refusal({.count = 9}, Rays{}.with_border(ClipAtEmitter{0})).find("least_radius is 0") != std::string::npos);
    CHECK(refusal({.count = 9}, Rays{}.with_visibility(ShortRays{0})).find("radii is 0") != std::string::npos);
    CHECK(splat_rays(room, lamp, none, {.count = 500}).flights[Fate::unseen].photons >= 500);
    const Vertices one{{V(0.5f, 0, 0.5f), V(0, 1, 0)}};
    CHECK(picture(room, lamp, one, {.count = 2000, .smoothing = 20},
                  Rays{}.with_width(FixedRayWidth{0.2}).with_filter(NoPixelFilter{}))[0] > 0);
}

} // namespace nephroid::tests::splat_rays_test
