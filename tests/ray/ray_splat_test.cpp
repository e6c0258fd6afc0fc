// SPDX-License-Identifier: MIT
#include "nephroid/ray/ray_splatter.hpp"

#include "bounce/closed_rooms.hpp"
#include "support/space.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace nephroid::tests::ray_splat_test {

using tests::Draws;

namespace {

template <class V>
V somewhere(Draws& draw, double size = 1) {
    using T = scalar_t<V>;
    const double x = draw.in(-size, size), y = draw.in(-size, size), z = draw.in(-size, size);
    return V(T(x), T(y), T(z));
}

/// Vertices on the walls of a room, and some in the air with any normal.
template <class T>
std::vector<RoomVertex<T>> room(int count) {
    using V = glm::vec<3, T>;
    Draws draw(5);
    std::vector<RoomVertex<T>> all;
    for (int i = 0; i < count; ++i) {
        V p = somewhere<V>(draw), n = normalize(somewhere<V>(draw));
        if (i % 4 != 0) {
            n = V(0, 0, 0);
            n[i % 3] = T(i % 2 == 0 ? 1 : -1);
            p[i % 3] = -n[i % 3];
        }
        all.push_back({p, n});
    }
    return all;
}

/// Flights of every kind: endless ones, along an axis, converging ones, from a vertex, with a surface behind.
template <class T>
Flight<glm::vec<3, T>, T, 2> some_flight(Draws& draw, int round, const std::vector<RoomVertex<T>>& vertices) {
    using V = glm::vec<3, T>;
    V origin = somewhere<V>(draw), direction = normalize(somewhere<V>(draw));
    if (round % 5 == 0) {
        direction = V(0, 0, 0);
        direction[round % 3] = T(round % 2 == 0 ? 1 : -1);
    }
    if (round % 7 == 0)
        origin = vertices[std::size_t(draw.in(0, double(vertices.size())))].position;
    const T width = T(round % 4 == 0 ? 0.5 : 0.2);
    PhotonDifferential<V, 2> tangents;
    for (Tangent<V>& tangent : tangents)
        tangent = {width * somewhere<V>(draw), (round % 3 == 0 ? -width : width) * somewhere<V>(draw)};
    Flight<V, T, 2> flight{origin, direction, T(draw.in(0.2, 2)), T(1), tangents, std::nullopt, std::nullopt, 1, 0};
    V left = normalize(somewhere<V>(draw)), met = normalize(somewhere<V>(draw));
    if (round % 2 == 0)
        flight.origin_normal = dot(left, direction) < T(0) ? -left : left;
    if (round % 6 == 0)
        flight.distance = std::numeric_limits<T>::infinity();
    else
        flight.end_normal = dot(met, direction) > T(0) ? -met : met;
    return flight;
}

/// What a flight makes at a vertex by the definition, in double: the beam's matrix is inverted. Nothing if the vertex
/// is so near to a border of what receives that rounding decides.
template <class T>
std::optional<double> by_definition(const Flight<glm::vec<3, T>, T, 2>& flight, const RoomVertex<T>& vertex,
                                    double reach) {
    using D = glm::dvec3;
    const D o(flight.origin), d(flight.direction), p(vertex.position), n(vertex.normal), r = p - o;
    const double t = dot(r, d), facing = -dot(n, d), margin = 1e-4;
    const D q = r - t * d;
    const auto column = [&](std::size_t i) {
        const D c = 0.5 * (D(flight.tangents[i].d_position) + t * D(flight.tangents[i].d_direction));
        return c - dot(c, d) * d;
    };
    const D a = column(0), b = column(1);
    if (facing < -margin || t < -margin || std::sqrt(dot(q, q)) > std::sqrt(dot(a, a)) + std::sqrt(dot(b, b)) + margin)
        return 0.0; // far from the beam, or seen from behind
    const double area = dot(cross(a, b), d);
    if (std::abs(area) < 1e-5)
        return std::nullopt; // thin: float is not enough to say
    const double x = dot(cross(q, b), d) / area, y = dot(cross(a, q), d) / area, r2 = x * x + y * y;
    double distance_to_border = (std::min)({std::abs(t), std::abs(facing), std::abs(r2 - 1)});
    bool receives = t > 0 && facing > 0 && r2 < 1;
    if (flight.origin_normal) {
        const double height = dot(r, D(*flight.origin_normal));
        receives = receives && height > 0;
        distance_to_border = (std::min)(distance_to_border, std::abs(height));
    }
    if (flight.end_normal && t > double(flight.distance) - margin) {
        const D e = p - (o + double(flight.distance) * d);
        const double height = dot(e, D(*flight.end_normal));
        receives = receives && (t <= double(flight.distance) || height >= 0);
        distance_to_border = (std::min)({distance_to_border, std::abs(height), std::abs(t - double(flight.distance))});
        if (receives && t > double(flight.distance) + reach)
            return std::nullopt; // bounded there
    }
    if (distance_to_border < margin)
        return std::nullopt;
    return receives ? BiweightKernel{}(r2) / std::abs(area) * facing : 0.0;
}

} // namespace

// float keeps 7 digits, and a thin beam's r² loses some; values are compared with what is largest in them.
TEST_CASE_TEMPLATE("ray: flights light the vertices that the definition lights, by as much", T, float, double) {
    using V = glm::vec<3, T>;
    const auto vertices = room<T>(3000);
    const auto map = map_of(vertices);
    const auto policies = Rays{}.with_filter(NoPixelFilter{});
    Draws draw(6);
    std::size_t lit = 0, wrong = 0, unsure = 0, visited = 0;
    for (int round = 0; round < 600; ++round) {
        const auto flight = some_flight<T>(draw, round, vertices);
        const auto outcome = make_ray_splat(flight, map, policies);
        std::vector<double> found(vertices.size(), 0.0);
        double reach = 0;
        if (outcome.splat) {
            REQUIRE(!outcome.bounded);
            reach = double(outcome.splat->depth[1]) - double(flight.distance);
            detail::for_each_reached_leaf(
                map, *outcome.splat, detail::EveryLeaf{}, [&](std::uint32_t leaf, const detail::LeafMeeting& meeting) {
                    std::array<T, PointTree<V>::leaf_size> weight;
                    detail::ray_weights(*outcome.splat, meeting.checks_height, leaf, map, policies, weight);
                    const TreeLeaf at = map.tree().leaves()[leaf];
                    for (std::size_t i = 0; i < at.size; ++i, ++visited)
                        found[map.tree().index(at.first + i)] = double(weight[i]);
                });
        }
        for (std::size_t i = 0; i < vertices.size(); ++i)
            if (const auto expected = by_definition(flight, vertices[i], reach)) {
                lit += *expected > 0;
                wrong += std::abs(found[i] - *expected) > 1e-2 * (1 + *expected);
            } else {
                ++unsure;
            }
    }
    CHECK(lit > 3000);
    CHECK(wrong == 0);
    CHECK(unsure < 600 * 3000 / 20);
    CHECK(visited < 600 * 3000 / 4); // the walk leaves out most of them
}

// All leaves, one by one, against those that the walk visits.
TEST_CASE_TEMPLATE("ray: the walk finds exactly the vertices that a test of all leaves finds", T, float, double) {
    using V = glm::vec<3, T>;
    const auto vertices = room<T>(4000);
    const auto map = map_of(vertices);
    const auto policies = Rays{}.with_ends(EndAtPlaneOrBall{});
    Draws draw(7);
    std::size_t taken = 0, tested = 0, missed = 0;
    for (int round = 0; round < 2000; ++round) {
        const auto outcome = make_ray_splat(some_flight<T>(draw, round, vertices), map, policies);
        if (!outcome.splat)
            continue;
        std::array<T, PointTree<V>::leaf_size> weight;
        const auto count = [&](std::uint32_t leaf, bool checks) {
            std::size_t sum = 0;
            detail::ray_weights(*outcome.splat, checks, leaf, map, policies, weight);
            for (std::size_t i = 0; i < map.tree().leaves()[leaf].size; ++i)
                sum += weight[i] > T(0);
            return sum;
        };
        std::size_t all = 0, walked = 0;
        for (std::uint32_t leaf = 0; leaf < map.tree().leaves().size(); ++leaf)
            all += count(leaf, true);
        detail::for_each_reached_leaf(map, *outcome.splat, detail::EveryLeaf{},
                                      [&](std::uint32_t leaf, const detail::LeafMeeting& meeting) {
                                          walked += count(leaf, meeting.checks_height);
                                          tested += map.tree().leaves()[leaf].size;
                                      });
        missed += all - walked;
        taken += all;
    }
    CHECK(missed == 0);
    CHECK(taken > 10'000);
    CHECK(tested > taken);
}

TEST_CASE("ray: flights that are no flights are counted, and light nothing") {
    using V = glm::vec3;
    const auto vertices = room<float>(200);
    const auto map = map_of(vertices), empty = map_of(std::vector<RoomVertex<float>>{});
    Draws draw(8);
    const auto good = some_flight<float>(draw, 1, vertices);
    const float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    const auto fate = [&](const auto& change, const Rays& policies = {}) {
        auto flight = good;
        change(flight);
        return make_ray_splat(flight, map, policies).fate;
    };
    using Some = Flight<V, float, 2>;
    CHECK(fate([](Some&) {}) == Fate::splatted);
    CHECK(fate([](Some& f) { f.distance = 0; }) == Fate::invalid);
    CHECK(fate([&](Some& f) { f.distance = nan; }) == Fate::invalid);
    CHECK(fate([&](Some& f) { f.origin.x = nan; }) == Fate::invalid);
    CHECK(fate([&](Some& f) { f.origin.x = infinity; }) == Fate::invalid);
    CHECK(fate([](Some& f) { f.direction = 2.0f * f.direction; }) == Fate::invalid);
    CHECK(fate([&](Some& f) { f.flux = nan; }) == Fate::invalid);
    CHECK(fate([&](Some& f) { f.tangents[0].d_direction.y = nan; }) == Fate::invalid);
    CHECK(fate([](Some& f) { f.origin = V(5, 5, 5), f.direction = V(1, 0, 0); }) == Fate::unseen);
    CHECK(make_ray_splat(good, empty, Rays{}).fate == Fate::unseen);
    auto thin = good;
    for (Tangent<V>& tangent : thin.tangents)
        tangent = {V(0, 0, 0), V(0, 0, 0)};
    CHECK(make_ray_splat(thin, map, Rays{}.with_filter(NoPixelFilter{})).fate == Fate::collapsed);
    CHECK(make_ray_splat(thin, map, Rays{}).fate == Fate::splatted); // as wide as the filter
    auto wide = good;
    for (Tangent<V>& tangent : wide.tangents)
        tangent = {V(100, 0, 3), V(1, 200, 0)};
    const auto bounded = make_ray_splat(wide, map, Rays{});
    REQUIRE(bounded.splat.has_value());
    CHECK(bounded.bounded);
    CHECK(bounded.splat->outer_radius[0] <= 1.01f * map.diagonal());
}

} // namespace nephroid::tests::ray_splat_test
