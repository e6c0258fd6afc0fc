// SPDX-License-Identifier: MIT
#include "nephroid/illuminate.hpp"

#include "nephroid/emission/light/point.hpp"
#include "nephroid/emission/light/spot.hpp"
#include "nephroid/emission/light/standard_lights.hpp"
#include "nephroid/execution/thread_executor.hpp"

#include "bounce/closed_rooms.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace nephroid::tests::illuminate_test {

using V = glm::vec3;

namespace {

/// What each vertex gets.
struct Picture {
    std::vector<float> caustic, indirect;

    explicit Picture(const Illumination<V, float>& light, std::size_t vertices)
        : caustic(vertices), indirect(vertices) {
        light.for_each([&](std::size_t vertex, float by_mirrors, float by_walls) {
            caustic[vertex] = by_mirrors;
            indirect[vertex] = by_walls;
        });
    }
};

/// A room with a mirror for a ceiling, and a lamp below it.
[[nodiscard]] Room<float> room_with_mirror() {
    Room<float> room = furnace<float>();
    room.walls[3].event = Event::reflect;
    room.walls[3].albedo = 1;
    return room;
}

[[nodiscard]] std::string message_of(const IlluminationPass<V>& pass) {
    const Room<float> room = furnace<float>();
    const auto vertices = room.vertices(4, {2});
    const auto map = map_of(vertices);
    Illumination<V, float> light(map, room);
    try {
        illuminate(room, PointLight<V, float>({{0.5f, 0.5f, 0.5f}, 1.0f}), light, pass);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
}

} // namespace

// The mirror makes a second lamp of the same power at y = 1.5. A lamp of intensity I at height h lights the floor below
// by I/h²; what both send to diffuse walls, Φ (all of it), makes Φ ρ/(1 − ρ) of indirect light on 5 of 6 sides
// of area 1.
TEST_CASE("illuminate: caustics are of the mirror alone, and indirect light of the walls alone") {
    const Room<float> room = room_with_mirror();
    const auto vertices = room.vertices(12, {0, 1, 2, 4, 5});
    const auto map = map_of(vertices);
    Illumination<V, float> light(map, room);
    const float intensity = float(1 / (4 * std::numbers::pi));
    const PointLight<V, float> lamp({{0.5f, 0.5f, 0.5f}, intensity});
    const BoundingSphere<V> target{V(0.5f, 1.6f, 0.5f), 0.93f}; // through the corners of the ceiling
    const auto statistics =
        illuminate(room, lamp, light, {.global = {.count = 4000}, .caustic = {.count = 4000, .target = target}});
    const Picture picture(light, vertices.size());
    double indirect = 0;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        indirect += picture.indirect[i] / double(vertices.size());
        if (vertices[i].normal.y > 0.5f) { // of the image of the lamp: I cos/r²
            const V way = vertices[i].position - V(0.5f, 1.5f, 0.5f);
            const double r2 = dot(way, way);
            CHECK(picture.caustic[i] == doctest::Approx(intensity * 1.5 / (r2 * std::sqrt(r2))).epsilon(0.1));
        }
    }
    CHECK(indirect == doctest::Approx(1.0 / 5).epsilon(0.06)); // 1 ± √2 deposits of 4,000 photons
    // The lamp sees the target within 57°, (1 - cos 57°)/2 of all directions.
    CHECK(statistics.caustic.emitted.flux < 0.25);
    CHECK(statistics.global.statistics.emitted.flux == doctest::Approx(1));
    CHECK(statistics.global.statistics[Arrival::caustic].flux > 0);
}

// 4, 8, … 256 passes of a small furnace: the log slope of the error should be about −0.37, measured.
TEST_CASE("illuminate: the mean of passes converges as their disks shrink") {
    const Room<float> room = furnace<float>();
    const auto lamp = room.glow(0.5f, {0, 1, 2, 3, 4, 5});
    const auto vertices = room.vertices(6, {0, 1, 2, 3, 4, 5});
    const auto map = map_of(vertices);
    Illumination<V, float> light(map, room);
    const auto error = [&] {
        const Picture picture(light, vertices.size());
        double sum = 0;
        for (const float e : picture.indirect)
            sum += square(e - 0.5);
        return std::sqrt(sum / double(vertices.size())) / 0.5;
    };
    double after_4 = 0, radius = 1;
    for (int pass = 1; pass <= 64; ++pass) {
        const auto statistics = illuminate(room, lamp, light, {.global = {.count = 500}});
        CHECK(statistics.global.radius < radius);
        radius = statistics.global.radius;
        if (pass == 4)
            after_4 = error();
    }
    CHECK(light.indirect_part().passes == 64);
    CHECK(std::log(error() / after_4) / std::log(16.0) < -0.25);
    CHECK(error() < 0.05); // measured 0.03
    light.clear();
    CHECK(light.indirect_part().passes == 0);
    CHECK(Picture(light, vertices.size()).indirect == std::vector<float>(vertices.size(), 0.0f));
}

TEST_CASE("illuminate: caustics and indirect light are means over the passes that had them") {
    const Room<float> room = room_with_mirror();
    const auto vertices = room.vertices(6, {2});
    const auto map = map_of(vertices);
    const PointLight<V, float> lamp({{0.5f, 0.5f, 0.5f}, 1.0f});
    Illumination<V, float> light(map, room);
    illuminate(room, lamp, light, {.global = {.count = 500}, .caustic = {.count = 1000}});
    const Picture first(light, vertices.size());
    for (int pass = 0; pass < 3; ++pass)
        illuminate(room, lamp, light, {.global = {.count = 200}});
    CHECK(Picture(light, vertices.size()).caustic == first.caustic);
    CHECK(Picture(light, vertices.size()).indirect != first.indirect);
    CHECK(light.caustic_part().passes == 1);
    CHECK(light.caustic_part().next == 1000);
    CHECK(light.indirect_part().passes == 4);
    CHECK(light.indirect_part().next == 1100);
}

TEST_CASE("illuminate: a pass that is refused adds nothing") {
    Room<float> room = room_with_mirror();
    const auto vertices = room.vertices(4, {2});
    const auto map = map_of(vertices);
    const PointLight<V, float> lamp({{0.5f, 0.5f, 0.5f}, 1.0f});
    Illumination<V, float> light(map, room);
    for (auto& wall : room.walls)
        if (wall.event == Event::diffuse)
            wall.event = Event::deposit;
    CHECK_THROWS_AS(illuminate(room, lamp, light, {.global = {.count = 4000}, .caustic = {.count = 1000}}),
                    std::invalid_argument);
    CHECK(light.caustic_part().passes == 0);
    for (const float caustic : Picture(light, vertices.size()).caustic)
        CHECK(caustic == 0);
}

// Five photons leave fewer than 64 deposits, 2,000 some 2,000.
TEST_CASE("illuminate: a radius that too few photons were there to choose is chosen by a later pass") {
    const Room<float> room = furnace<float>();
    const auto vertices = room.vertices(6, {2});
    const auto map = map_of(vertices);
    const PointLight<V, float> lamp({{0.5f, 0.5f, 0.5f}, 1.0f});
    Illumination<V, float> light(map, room);
    const auto early = illuminate(room, lamp, light, {.global = {.count = 5}});
    CHECK(!early.global.is_radius_chosen);
    CHECK(!light.radius());
    const auto late = illuminate(room, lamp, light, {.global = {.count = 2000}});
    CHECK(late.global.is_radius_chosen);
    CHECK(late.global.radius <= early.global.radius);
    REQUIRE(light.radius());
    CHECK(*light.radius() < late.global.radius);
    // Every deposit of indirect light is told of.
    CHECK(late.global.disks[Fate::splatted].flux + late.global.disks[Fate::unseen].flux ==
          doctest::Approx(late.global.statistics[Arrival::indirect].flux).epsilon(1e-4));
}

TEST_CASE("illuminate: any number of threads makes the same light, bit for bit") {
    const Room<float> room = room_with_mirror();
    const auto vertices = room.vertices(8, {0, 2});
    const auto map = map_of(vertices);
    const PointLight<V, float> lamp({{0.5f, 0.5f, 0.5f}, 1.0f});
    ThreadExecutor threads(2);
    Illumination<V, float> one(map, room), two(map, room, {}, threads);
    for (int pass = 0; pass < 2; ++pass) {
        illuminate(room, lamp, one, {.global = {.count = 1000}, .caustic = {.count = 1000}});
        illuminate(room, lamp, two, {.global = {.count = 1000}, .caustic = {.count = 1000}}, threads);
    }
    CHECK(Picture(one, vertices.size()).caustic == Picture(two, vertices.size()).caustic);
    CHECK(Picture(one, vertices.size()).indirect == Picture(two, vertices.size()).indirect);
}

TEST_CASE("illuminate: what cannot be is refused with a sentence") {
    CHECK(message_of({}).find("zero photons") != std::string::npos);
    CHECK(message_of({.global = {.count = 10, .alpha = 0}}).find("alpha is 0") != std::string::npos);
    CHECK(message_of({.global = {.count = 10, .radius = 0}}).find("radius is 0") != std::string::npos);
    CHECK(message_of({.caustic = {.count = 10, .target = BoundingSphere<V>{V(0), -1}}}).find("target") !=
          std::string::npos);
    CHECK(message_of({.global = {.count = 10}}).empty());
}

// A light that is aimed sends the same flux to each point inside of the target.
TEST_CASE("lights: aimed at a sphere they are what they are with that target") {
    const BoundingSphere<V> target{{2, 3, 4}, 0.5f};
    const auto check = [&](const auto& plain, const auto& aimed) {
        using L = std::remove_cvref_t<decltype(plain)>;
        static_assert(AimsAt<L, V>);
        const HaltonSequence halton;
        for (std::uint64_t i = 0; i < 20; ++i) {
            Sampler<HaltonSequence> one(halton, i), other(halton, i);
            const auto a = plain.aimed_at(target).emit(one, {20, 1}), b = aimed.emit(other, {20, 1});
            CHECK(length(V(a.position - b.position)) < 1e-5f);
            CHECK(length(V(a.direction - b.direction)) < 1e-5f);
            CHECK(a.flux == doctest::Approx(b.flux).epsilon(1e-5));
        }
    };
    using P = PointLight<V, float>;
    check(P({{1, 0, 0}, 2.0f}), P({{1, 0, 0}, 2.0f, target}));
    using S = SpotLight<V, float>;
    check(S({{1, 0, 0}, {1, 3, 4}, 0.9f, 0.5f, 2.0f}), S({{1, 0, 0}, {1, 3, 4}, 0.9f, 0.5f, 2.0f, target}));
    using Q = QuadLight<V, float>;
    check(Q({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 3.0f}), Q({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 3.0f, target}));
    using K = DiskLight<V, float>;
    check(K({{0, 0, 0}, {0, 0, 1}, 1, 3.0f}), K({{0, 0, 0}, {0, 0, 1}, 1, 3.0f, target}));
    using B = SphereLight<V, float>;
    check(B({{0, 0, 0}, 1, 3.0f}), B({{0, 0, 0}, 1, 3.0f, target}));
    using M = MeshLight<V, float>;
    const std::vector<M::Triangle> triangles{{{V(0), V(1, 0, 0), V(0, 1, 0)}}};
    check(M({triangles, 3.0f}), M({triangles, 3.0f, target}));
    using Sun = DirectionalLight<V, float>;
    const BoundingSphere<V> scene{{0, 0, 0}, 10};
    check(Sun({{0, 0, -1}, 1.0f, BoundingSphere<V>{V(0), 10}, scene}), Sun({{0, 0, -1}, 1.0f, target, scene}));
    using Set = LightSet<P, Q>;
    check(Set({P({{1, 0, 0}, 2.0f})}), Set({P({{1, 0, 0}, 2.0f, target})}));
}

} // namespace nephroid::tests::illuminate_test
