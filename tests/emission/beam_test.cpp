// SPDX-License-Identifier: MIT
#include "nephroid/emission/beam.hpp"

#include "nephroid/sequence/random.hpp"
#include "nephroid/vector/glm.hpp"
#include "support/sphere_direction.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <stdexcept>
#include <vector>

namespace nephroid::tests::beam_test {

namespace {

template <class V>
std::vector<V> box(const V& low, const V& high) {
    std::vector<V> corners;
    for (const auto x : {low.x, high.x})
        for (const auto y : {low.y, high.y})
            for (const auto z : {low.z, high.z})
                corners.push_back(V(x, y, z));
    return corners;
}

template <class V>
scalar_t<V> area_of(const BeamPatch<V>& patch) {
    if (const auto* disk = std::get_if<BeamDisk<V>>(&patch))
        return pi<scalar_t<V>> * disk->radius * disk->radius;
    const auto& quad = std::get<Parallelogram<V>>(patch);
    return length(cross(quad.edge_u, quad.edge_v));
}

/// Whether the beam from the patch passes the point: it lies ahead of the patch and within its sides.
template <class V>
bool lights(const BeamPatch<V>& patch, const V& direction, const V& p) {
    if (const auto* disk = std::get_if<BeamDisk<V>>(&patch)) {
        const V d = p - disk->centre;
        return dot(d, direction) > 0 && length(V(d - dot(d, direction) * direction)) <= disk->radius;
    }
    const auto& quad = std::get<Parallelogram<V>>(patch);
    const V d = p - quad.corner;
    const auto u = dot(d, quad.edge_u) / length2(quad.edge_u), v = dot(d, quad.edge_v) / length2(quad.edge_v);
    return dot(d, direction) > 0 && u >= 0 && u <= 1 && v >= 0 && v <= 1;
}

} // namespace

TEST_CASE("beam: a box that faces the beam is covered by its own face") {
    for (const double turn : {0.0, 0.3, 0.7853981633974483, 1.2}) {
        CAPTURE(turn);
        std::vector<glm::dvec3> corners;
        for (const glm::dvec3& p : box<glm::dvec3>({-2, -1, -1}, {2, 1, 1}))
            corners.push_back(
                {std::cos(turn) * p.x - std::sin(turn) * p.y, std::sin(turn) * p.x + std::cos(turn) * p.y, p.z});
        const auto patch = smallest_beam_over(glm::dvec3(0, 0, -5), corners);
        CHECK(area_of(patch) == doctest::Approx(4 * 2).epsilon(1e-12));
    }
}

TEST_CASE("beam: points on a circle are covered by a disk") {
    std::vector<glm::dvec3> circle;
    for (int i = 0; i < 90; ++i)
        circle.push_back({std::cos(i * pi<double> / 45), std::sin(i * pi<double> / 45), 0});
    const auto patch = smallest_beam_over(glm::dvec3(0, 0, -1), circle);
    REQUIRE(std::holds_alternative<BeamDisk<glm::dvec3>>(patch));
    CHECK(area_of(patch) == doctest::Approx(pi<double>).epsilon(1e-12));
}

// Brute force: no turn of 1000 makes a rectangle of less area. The patch is padded by 16 epsilon of the bounds' radius.
TEST_CASE_TEMPLATE("beam: points are lit and no turned rectangle is smaller", T, float, double) {
    using V = glm::vec<3, T>;
    const RandomSequence random(8);
    for (std::uint64_t i = 0; i < 60; ++i) {
        const auto at = [&](std::uint32_t d) { return random.sample<T>(i, d); };
        const T size = std::pow(T(10), 8 * at(0) - 4);
        const V direction = sphere_direction<V>(at(1), at(2));
        std::vector<V> points;
        for (std::uint32_t k = 0; k < 12; ++k)
            points.push_back(size * V(at(3 + 3 * k), at(4 + 3 * k), T(0.3) * at(5 + 3 * k)));
        const auto patch = smallest_beam_over(direction, points);
        for (const V& p : points)
            CHECK(lights(patch, direction, p));

        const Frame<V> frame = frame_about(direction);
        T smallest = std::numeric_limits<T>::max();
        for (int k = 0; k < 1000; ++k) {
            const T angle = T(k) / 1000 * pi<T> / 2;
            const V u = std::cos(angle) * frame.u + std::sin(angle) * frame.v, v = cross(direction, u);
            T low_u = dot(points[0], u), high_u = low_u, low_v = dot(points[0], v), high_v = low_v;
            for (const V& p : points) {
                low_u = (std::min)(low_u, dot(p, u)), high_u = (std::max)(high_u, dot(p, u));
                low_v = (std::min)(low_v, dot(p, v)), high_v = (std::max)(high_v, dot(p, v));
            }
            smallest = (std::min)(smallest, (high_u - low_u) * (high_v - low_v));
        }
        CHECK(area_of(patch) <= smallest * (1 + 1000 * std::numeric_limits<T>::epsilon()));
    }
}

TEST_CASE("beam: a flat target met edge-on and points on a line get a narrow patch") {
    const auto edge_on = smallest_beam_over(glm::dvec3(1, 0, 0), box<glm::dvec3>({0, 0, 0}, {1, 1, 0}));
    CHECK(area_of(edge_on) == doctest::Approx(1e-3).epsilon(1e-9));
    const std::vector<glm::dvec3> line{{0, 0, 0}, {0, 1, 0}, {0, 3, 0}};
    CHECK(area_of(smallest_beam_over(glm::dvec3(0, 0, 1), line)) == doctest::Approx(9e-3).epsilon(1e-9));
}

TEST_CASE("beam: no points and a line along the beam and a beam without direction are refused") {
    using V = glm::dvec3;
    const V down(0, 0, -1);
    CHECK_THROWS_AS((void)smallest_beam_over(down, std::vector<V>{}), std::invalid_argument);
    CHECK_THROWS_AS((void)smallest_beam_over(down, std::vector<V>{{1, 2, 3}}), std::invalid_argument);
    CHECK_THROWS_AS((void)smallest_beam_over(down, std::vector<V>{{1, 2, 3}, {1, 2, 3}}), std::invalid_argument);
    CHECK_THROWS_AS((void)smallest_beam_over(down, std::vector<V>{{1, 2, 3}, {1, 2, 7}}), std::invalid_argument);
    CHECK_THROWS_AS((void)smallest_beam_over(V(0, 0, 0), std::vector<V>{{0, 0, 0}, {1, 2, 7}}), std::invalid_argument);
}

} // namespace nephroid::tests::beam_test
