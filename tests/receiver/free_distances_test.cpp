// SPDX-License-Identifier: MIT
#include "nephroid/receiver/free_distances.hpp"

#include "nephroid/execution/thread_executor.hpp"

#include "bounce/closed_rooms.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace nephroid::tests::free_distances_test {

using D = glm::dvec3;

namespace {

/// The direction that a distance belongs to, about a vertex that looks upwards.
[[nodiscard]] D direction(std::size_t i, std::size_t count, const D& normal) {
    const Frame<D> frame = frame_about(normal);
    const double angle = 2 * std::numbers::pi * (double(i) + 0.5) / double(count);
    return std::cos(angle) * frame.u + std::sin(angle) * frame.v;
}

/// The distance within the unit square to its border.
[[nodiscard]] double to_border(const D& p, const D& d) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const int axis : {0, 2})
        if (d[axis] != 0)
            nearest = std::min(nearest, ((d[axis] > 0 ? 1.0 : 0.0) - p[axis]) / d[axis]);
    return nearest;
}

/// Checks the distances of all vertices of a floor, the unit square.
template <class S>
void check_floor(const S& scene, const std::vector<RoomVertex<double>>& vertices, double tolerance) {
    const auto map = map_of(vertices);
    const FreeDistances<D> distances(map, scene, {.reach = 0.7});
    REQUIRE(distances.directions() == 32);
    for (std::size_t slot = 0; slot < map.tree().leaves()[0].size; ++slot) {
        const RoomVertex<double>& v = vertices[map.tree().index(slot)];
        for (std::size_t i = 0; i < 32; ++i) {
            const double exact = std::min(0.7, to_border(v.position, direction(i, 32, v.normal)));
            CHECK(distances.distance(slot, i) >= exact - tolerance);
            CHECK(distances.distance(slot, i) <= exact + 0.7 / 65535);
        }
    }
}

/// A tracer that finds nothing closer than a tenth of the room.
struct BlindAtFirst : Room<double> {
    static constexpr double tracer_epsilon = 0.1;
    [[nodiscard]] auto intersect(const D& o, const D& d, double t_min, double t_max) const {
        return Room<double>::intersect(o, d, std::max(t_min, tracer_epsilon), t_max);
    }
};

[[nodiscard]] std::string message_of(const FreeDistanceOptions& options) {
    const auto room = furnace<double>();
    const auto vertices = room.vertices(2, {2});
    const auto map = map_of(vertices);
    try {
        FreeDistances<D>(map, room, options);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
}

} // namespace

// Walls are met by one ray, exactly but for the two bytes that a distance is stored in.
TEST_CASE("free distances: in a box they end at its walls") {
    const auto room = furnace<double>();
    check_floor(room, room.vertices(7, {2}), 0.7 / 65535);
}

// Edges are found to a 64th of their distance, and never too far.
TEST_CASE("free distances: on a table they end at its edges") {
    Room<double> table = furnace<double>();
    table.walls = {table.walls[2]};
    check_floor(table, table.vertices(7, {0}), 0.7 / 64 + 0.7 / 65535);
}

TEST_CASE("free distances: a floor far below does not go on with a table, a low step does") {
    Room<double> room = furnace<double>();
    const D x{1, 0, 0}, z{0, 0, 1};
    room.walls = {{D(0), z, x, 0.5}, {D(1, -0.5, 0), z, x, 0.5}};
    const auto vertices = room.vertices(7, {0});
    check_floor(room, vertices, 0.7 / 64 + 0.7 / 65535);
    room.walls[1].corner.y = -0.005;
    const auto map = map_of(vertices);
    const FreeDistances<D> distances(map, room, {.reach = 0.7});
    for (std::size_t slot = 0; slot < 49; ++slot) // towards the step, whose far end is at x = 2
        for (std::size_t i = 0; i < 32; ++i)
            if (const D d = direction(i, 32, D(0, 1, 0)); d.x > 0.99)
                CHECK(distances.distance(slot, i) == doctest::Approx(0.7));
}

TEST_CASE("free distances: a tracer that skips the start of its rays finds the same") {
    const BlindAtFirst blind{furnace<double>()};
    check_floor(blind, blind.vertices(7, {2}), 0.7 / 65535);
}

// A sphere bends by t²/2r off its tangent plane, a quarter of the distance where the chord is r/2.
TEST_CASE("free distances: a curved surface goes on until it has left the tangent plane by a quarter") {
    const SphereRoom<double> sphere;
    auto vertices = sphere.vertices(60);
    for (int side = 0; side < 2; ++side) { // from inside, then from outside
        const auto map = map_of(vertices);
        const FreeDistances<D> near_by(map, sphere, {.reach = 0.4}), far(map, sphere, {.reach = 0.9});
        for (std::size_t slot = 0; slot < map.tree().leaves()[0].size; ++slot) {
            CHECK(near_by.coverage(slot, 0.4, BiweightKernel{}) == 1);
            for (std::size_t i = 0; i < 32; ++i) {
                CHECK(far.distance(slot, i) > 0.43);
                CHECK(far.distance(slot, i) < 0.62);
            }
        }
        for (RoomVertex<double>& vertex : vertices)
            vertex.normal = -vertex.normal;
    }
}

// A half at a straight wall and a quarter in a corner, by symmetry; 32 directions are off by a hundredth.
TEST_CASE("free distances: coverage is the share of the kernel on the surface") {
    const auto room = furnace<double>();
    const double tiny = 1e-6;
    const std::vector<RoomVertex<double>> vertices{{D(0.5, 0, 0.5), D(0, 1, 0)},
                                                   {D(tiny, 0, 0.5), D(0, 1, 0)},
                                                   {D(tiny, 0, tiny), D(0, 1, 0)},
                                                   {D(0.1, 0, 0.5), D(0, 1, 0)}};
    const auto map = map_of(vertices);
    const FreeDistances<D> distances(map, room);
    CHECK(distances.reach() > 0.2);
    const auto coverage = [&](std::size_t vertex, double radius, const auto& kernel) {
        std::size_t slot = 0;
        while (map.tree().index(slot) != vertex)
            ++slot;
        return distances.coverage(slot, radius, kernel);
    };
    CHECK(coverage(0, 0.2, BiweightKernel{}) == 1);
    CHECK(coverage(1, 0.2, BiweightKernel{}) == doctest::Approx(0.5).epsilon(0.01));
    CHECK(coverage(2, 0.2, ConeKernel{}) == doctest::Approx(0.25).epsilon(0.01));
    // Uniform: the disk less the segment beyond a chord at half of the radius, 1 − (2π/3 − √3/2)/(2π).
    CHECK(coverage(3, 0.2, UniformKernel{}) == doctest::Approx(0.804499).epsilon(0.01));
}

TEST_CASE("free distances: a place behind a wall is not reached, one in front of it is") {
    Room<double> room = furnace<double>();
    const D y{0, 1, 0}, z{0, 0, 1};
    room.walls.push_back({D(0.5, 0, 0), y, z, 0.5}); // a screen across the room, without thickness
    const std::vector<RoomVertex<double>> vertices{{D(0.4, 0, 0.5), D(0, 1, 0)}, {D(0.7, 0, 0.6), D(0, 1, 0)}};
    const auto map = map_of(vertices);
    const FreeDistances<D> distances(map, room, {.reach = 0.5});
    const std::size_t slot = map.tree().index(0) == 0 ? 0 : 1;
    CHECK(distances.reaches(slot, D(0.09, 0, 0)));
    CHECK(distances.reaches(slot, D(-0.3, 0, 0.1)));
    CHECK(!distances.reaches(slot, D(0.13, 0, 0)));
    CHECK(!distances.reaches(slot, D(0.2, 0, 0.1)));
    std::array<double, 64> weights{};
    weights[0] = weights[1] = 1;
    const D place = D(0.45, 0, 0.5) - map.tree().origin(); // on the first one's side
    distances.keep_reached(0, place.x, place.y, place.z, 1, weights);
    CHECK(weights[slot] == 1);
    CHECK(weights[1 - slot] == 0);
}

TEST_CASE("free distances: any number of threads finds the same, and rays are counted") {
    const auto room = furnace_with_block<float>();
    const auto vertices = room.vertices(16, {0, 1, 2, 3, 4, 5});
    const auto map = map_of(vertices);
    ThreadExecutor threads(2);
    const FreeDistances<glm::vec3> one(map, room), two(map, room, {}, threads);
    CHECK(one.rays() == two.rays());
    CHECK(one.rays() > 40 * vertices.size());
    CHECK(one.rays() < 200 * vertices.size());
    for (std::size_t slot = 0; slot < map.tree().slots(); ++slot)
        for (std::size_t i = 0; i < 32; ++i)
            REQUIRE(one.distance(slot, i) == two.distance(slot, i));
}

TEST_CASE("free distances: vertices with nothing near them ask eight directions") {
    Room<double> plain = furnace<double>();
    plain.walls = {{D(-50, 0, -50), D(0, 0, 100), D(100, 0, 0), 0.5}};
    const std::vector<RoomVertex<double>> vertices{{D(0), D(0, 1, 0)}, {D(1, 0, 0), D(0, 1, 0)}};
    const auto map = map_of(vertices);
    const FreeDistances<D> distances(map, plain, {.reach = 2});
    CHECK(distances.rays() == 2 * 8 * 5); // one along the surface, and four down
}

TEST_CASE("free distances: a vertex far away hardly changes the reach") {
    const auto room = furnace<double>();
    auto vertices = room.vertices(8, {0, 1, 2, 3, 4, 5});
    const auto map = map_of(vertices);
    vertices.push_back({D(300, 0, 0.5), D(0, 1, 0)});
    const auto wide = map_of(vertices);
    const FreeDistances<D> before(map, room), after(wide, room);
    CHECK(before.reach() == doctest::Approx(std::sqrt(3) / 3).epsilon(0.05));
    CHECK(after.reach() == doctest::Approx(before.reach()).epsilon(0.1));
}

TEST_CASE("free distances: from one place no reach follows") {
    const auto room = furnace<double>();
    const std::vector<RoomVertex<double>> vertices(3, {D(0.25, 0, 0.5), D(0, 1, 0)});
    const auto map = map_of(vertices);
    CHECK_THROWS_WITH_AS(FreeDistances<D>(map, room), doctest::Contains("give a reach"), std::invalid_argument);
    CHECK(FreeDistances<D>(map, room, {.reach = 0.5}).coverage(0, 0.4, BiweightKernel{}) < 1);
}

TEST_CASE("free distances: options that cannot be are refused, and an empty map has none") {
    CHECK(message_of({.reach = -1}).find("reach is -1") != std::string::npos);
    CHECK(message_of({.reach = std::numeric_limits<double>::infinity()}).find("reach is inf") != std::string::npos);
    CHECK(message_of({.directions = 0}).find("directions is 0") != std::string::npos);
    CHECK(message_of({.directions = 33}).find("directions is 33") != std::string::npos);
    CHECK(message_of({.directions = 64}).empty());
    const std::vector<RoomVertex<double>> none;
    const auto map = map_of(none);
    CHECK(FreeDistances<D>(map, furnace<double>()).rays() == 0);
}

} // namespace nephroid::tests::free_distances_test
