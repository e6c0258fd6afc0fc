// SPDX-License-Identifier: MIT
#include "common/unaimed_lights.hpp"

#include "common/rooms.hpp"
#include "examples/room_points.hpp"

#include "nephroid/illuminate.hpp"
#include "nephroid/sequence/halton.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace nephroid::examples::unaimed_lights_test {

using namespace nephroid::examples::testing;

namespace {

using Color = Vec3<float>;
using AnyLamp = Lamp<float, Color>;

/// The flux that reaches the upper side of a plate of side 2 about the origin, by 20,000 photons that start anywhere.
Color flux_on_plate(const Lamps<float, Color>& lamps, double& power) {
    const Scene<float> scene({{Quad<float>({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}), 0}},
                             {Material<Color>::diffuse(Color(0.5f))});
    const auto lights = unaimed_lights(lamps, scene);
    power = lights.power();
    const HaltonSequence sequence(1);
    constexpr std::uint64_t count = 20'000;
    Color sum(0);
    for (std::uint64_t i = 0; i < count; ++i) {
        Sampler sampler(sequence, i);
        const auto photon = lights.emit(sampler, Spread<float>{float(count), 5});
        const auto hit = scene.intersect(photon.position, photon.direction, 0, HUGE_VALF);
        if (hit && photon.direction.y < 0)
            sum += photon.flux;
    }
    return sum;
}

} // namespace

// Of 20,000 Halton photons at least an eighth meet the plate: their number is good to 1/sqrt(2,500) = 2% if it were
// random, and to much less as it is not.
TEST_CASE("unaimed lights: a plate gets from each lamp what its light is") {
    double power = 0;
    AnyLamp sun{.kind = AnyLamp::Kind::directional, .direction = {0.6f, -0.8f, 0}, .intensity = {1, 2, 3}};
    Color found = flux_on_plate({{sun}, {}, {}}, power);
    for (int band = 0; band < 3; ++band)
        CHECK(found[band] == doctest::Approx(4 * 0.8 * (band + 1)).epsilon(0.02)); // area · cosine · irradiance

    AnyLamp point{.position = {0, 1, 0}, .intensity = Color(1)};
    found = flux_on_plate({{point}, {}, {}}, power);
    CHECK(power == doctest::Approx(4 * std::numbers::pi).epsilon(1e-5));
    CHECK(found.x == doctest::Approx(4 * std::numbers::pi / 6).epsilon(0.02)); // a face of the cube about the lamp

    AnyLamp spot = point;
    spot.kind = AnyLamp::Kind::spot;
    spot.direction = {0, -1, 0};
    spot.cos_inner = std::cos(0.3f), spot.cos_outer = std::cos(0.6f);
    found = flux_on_plate({{spot}, {}, {}}, power);
    CHECK(found.x == doctest::Approx(power).epsilon(0.01)); // the plate catches all of it

    Lamps<float, Color> sky;
    sky.environments.push_back(
        std::make_shared<const Environment<float, Color>>(Environment<float, Color>::constant(Color(1))));
    found = flux_on_plate(sky, power);
    CHECK(found.x == doctest::Approx(4 * std::numbers::pi).epsilon(0.02)); // π per area
}

TEST_CASE("unaimed lights: no lamps and no scene are refused") {
    const Scene<float> nothing;
    const auto room = built_in_room<float>("box").value();
    const auto refuses = [](const Lamps<float, Color>& lamps, const Scene<float>& scene) {
        CHECK_THROWS_AS(static_cast<void>(unaimed_lights(lamps, scene)), std::invalid_argument);
    };
    refuses({}, room.scene);
    refuses(room.lamps, nothing);
}

// The library's indirect light in the examples' rooms against the path traced table of rooms_test.cpp, means over whole
// walls. Disks fill the dark edges from beside them: 1.5% at 20,000 photons over the three walls; a single wall gets a
// share of the light whose noise is another 1.5%.
TEST_CASE("unaimed lights: the library's indirect light in a room is that which paths find") {
    const auto room = built_in_room<float>("box").value();
    std::vector<EyeVertex<float, Color>> vertices;
    add_wall<float, Color>(vertices, {0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 24, 0);
    add_wall<float, Color>(vertices, {0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 24, 1);
    add_wall<float, Color>(vertices, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 24, 2);
    using Vertex = EyeVertex<float, Color>;
    const EyePathMap<Color> map(vertices, &Vertex::position, &Vertex::normal);
    Illumination<Color, Color> light(map, room.scene);
    illuminate(room.scene, unaimed_lights(room.lamps, room.scene), light, {.global = {.count = 20'000}});
    std::array<Color, 3> found{};
    light.for_each([&](std::size_t vertex, const Color& caustic, const Color& indirect) {
        CHECK(caustic == Color(0));
        found[vertices[vertex].pixel] += indirect * vertices[vertex].weight;
    });
    const std::array<Color, 3> expected{
        {{0.22918f, 0.18109f, 0.12674f}, {0.25295f, 0.23373f, 0.17625f}, {0.24049f, 0.19170f, 0.13640f}}};
    for (std::size_t wall = 0; wall < 3; ++wall)
        for (int band = 0; band < 3; ++band)
            CHECK(found[wall][band] == doctest::Approx(expected[wall][band]).epsilon(0.03));
}

} // namespace nephroid::examples::unaimed_lights_test
