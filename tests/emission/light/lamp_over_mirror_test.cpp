// SPDX-License-Identifier: MIT
// Every lamp under a mirror: what it lights by way of it is known in closed form.
#include "nephroid/caustics.hpp"
#include "nephroid/emission/light/standard_lights.hpp"
#include "support/is_sanitized.hpp"
#include "transport/tiny_scenes.hpp"
#include "support/vertex.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

namespace nephroid::tests::lamp_over_mirror_test {

using tests::Sheet;
using tests::SheetScene;

namespace {

using V = tests::Vec<double>;

constexpr double mirror_height = 2, lamp_height = 1;
/// From the lamp's mirror image to the floor.
constexpr double image_height = 2 * mirror_height - lamp_height;

using Vertex = tests::Vertex<V>;

/// Any lamp: the picture is compiled once for all.
using Lamp = StandardLights<V, double>;

/// The irradiance on the floor's [-1, 1]², 24 x 24 vertices, of a lamp below the mirror.
[[nodiscard]] std::vector<double> floor_lit_by(const Lamp& lamp, std::uint64_t photons, std::vector<Vertex>& floor) {
    constexpr int n = 24;
    floor.clear();
    for (int i = 0; i < n * n; ++i)
        floor.push_back({{(i % n + 0.5) * 2 / n - 1, (i / n + 0.5) * 2 / n - 1, 0}, {0, 0, 1}});
    const SheetScene<double> scene{
        {{{0, 0, mirror_height}, {0, 0, -1}, Event::reflect}, {{0, 0, 0}, {0, 0, 1}, Event::deposit}}};
    const EyePathMap map(floor, &Vertex::position, &Vertex::normal);
    auto sums = nephroid::sums<double>(map);
    const Statistics account = caustics(scene, lamp, sums, {.count = photons});
    tests::check_balance(account);
    std::vector<double> irradiance(floor.size());
    sums.for_each([&](std::size_t vertex, double e) { irradiance[vertex] += e; });
    return irradiance;
}

/// The rms error over the floor, as a part of the mean, against the exact irradiance at (x, y).
template <class Exact>
[[nodiscard]] double error_of(const Lamp::AnyLight& lamp, std::uint64_t photons, const Exact& exact) {
    std::vector<Vertex> floor;
    const std::vector<double> irradiance = floor_lit_by(Lamp({lamp}), photons, floor);
    double squares = 0, sum = 0;
    for (std::size_t i = 0; i < floor.size(); ++i) {
        const double truth = exact(floor[i].position);
        squares += square(irradiance[i] - truth);
        sum += truth;
    }
    const auto count = double(floor.size());
    return std::sqrt(squares / count) / (sum / count);
}

/// A point of unit intensity, straight below the middle of the mirror, as its image lights the floor.
[[nodiscard]] double by_point(const V& at) {
    return image_height / std::pow(square(image_height) + at.x * at.x + at.y * at.y, 1.5);
}

constexpr V lamp_position{0, 0, lamp_height};

} // namespace

// A part of 2.8% of the photons lands on this part of the floor: some 560 of 20,000, which find light as smooth as this
// to 2%. Eight times as many find it four times as well: to second order the error falls faster than by their root.
TEST_CASE("lamps over a mirror: a point lamp shines everywhere, with a target about it and without") {
    for (const std::optional<BoundingSphere<V>>& target :
         {std::optional<BoundingSphere<V>>(), std::optional<BoundingSphere<V>>({{0, 0, mirror_height}, 50}),
          std::optional<BoundingSphere<V>>({{1, 2, mirror_height}, 5})}) {
        CAPTURE(target.has_value());
        const PointLight<V, double> lamp({.position = lamp_position, .intensity = 1, .target = target});
        const double some = error_of(lamp, 20'000, by_point);
        CHECK(some <= 0.02);
        if (tests::is_sanitized) // which makes minutes of what follows
            continue;
        const double more = error_of(lamp, 160'000, by_point);
        CHECK(more <= 0.005);
    }
}

// The light's map is singular opposite to its axis, where all of the square's edge is one direction: there the error is
// larger, but it vanishes all the same.
TEST_CASE("lamps over a mirror: a point lamp whose worst direction is the mirror still converges" *
          doctest::skip(tests::is_sanitized)) {
    const PointLight<V, double> lamp(
        {.position = lamp_position,
         .intensity = 1,
         .target = BoundingSphere<V>{{0, 0, lamp_height - 40}, 50}}); // the axis points down
    const double some = error_of(lamp, 20'000, by_point);
    CAPTURE(some);
    const double more = error_of(lamp, 160'000, by_point);
    CAPTURE(more);
    CHECK(some <= 0.25);
    CHECK(more < some);
}

TEST_CASE("lamps over a mirror: a spot and a sun") {
    const SpotLight<V, double> spot({.position = lamp_position,
                                     .axis = {0, 0, 1},
                                     .cos_inner = 0.5,
                                     .cos_outer = -1, // all directions, fading
                                     .intensity = 1});
    CHECK(error_of(spot, 20'000, [](const V& at) { // cos > 3 / sqrt(11) = 0.9: full where it lands
              return by_point(at);
          }) <= 0.02);
    const DirectionalLight<V, double> sun(
        {.direction = {0.1, 0, 1}, .irradiance = 1, .patch = BeamDisk<V>{{0, 0, lamp_height}, 2.5}});
    CHECK(error_of(sun, 20'000, [](const V&) { return 1 / std::sqrt(1.01); }) <= 0.02);
}

// A lamp of radius r at distance h is a point of intensity L A, times 1 + O(r²/h²) = 3e-4 for r = 0.05, and that of a
// plane times the cosine. Their cells in four dimensions know less: 5%, and 10% on the sphere,
// whose positions turn as well.
TEST_CASE("lamps over a mirror: lamps with an area") {
    constexpr double radius = 0.05, area = pi<double> * radius * radius;
    const auto by_plane = [](const V& at) {
        const double distance2 = square(image_height) + at.x * at.x + at.y * at.y;
        return by_point(at) * image_height / std::sqrt(distance2);
    };
    const BoundingSphere<V> target{{0, 0, mirror_height}, 0.9};
    const DiskLight<V, double> disk(
        {.centre = lamp_position, .normal = {0, 0, 1}, .radius = radius, .radiance = 1 / area, .target = target});
    CHECK(error_of(disk, 40'000, by_plane) <= 0.05);
    const double side = std::sqrt(area);
    const QuadLight<V, double> quad({.corner = {-side / 2, -side / 2, lamp_height},
                                     .edge_u = {side, 0, 0},
                                     .edge_v = {0, side, 0},
                                     .radiance = 1 / area,
                                     .target = target});
    CHECK(error_of(quad, 40'000, by_plane) <= 0.05);
    const MeshLight<V, double> mesh(
        {.triangles = {{V{-side / 2, -side / 2, lamp_height}, V{side / 2, -side / 2, lamp_height},
                        V{side / 2, side / 2, lamp_height}},
                       {V{-side / 2, -side / 2, lamp_height}, V{side / 2, side / 2, lamp_height},
                        V{-side / 2, side / 2, lamp_height}}},
         .radiance = 1 / area,
         .target = target});
    CHECK(error_of(mesh, 40'000, by_plane) <= 0.05);
    const SphereLight<V, double> sphere(
        {.centre = lamp_position, .radius = radius, .radiance = 1 / area, .target = target});
    CHECK(error_of(sphere, 40'000, by_point) <= 0.1);
}

} // namespace nephroid::tests::lamp_over_mirror_test
