// SPDX-License-Identifier: MIT
#include "nephroid/image/draw_sheets.hpp"

#include "image/wave_scene.hpp"
#include "nephroid/execution/thread_executor.hpp"
#include "nephroid/image/projected_chart.hpp"
#include "nephroid/image/see_receiver.hpp"
#include "nephroid/image/trace_buffer.hpp"
#include "nephroid/quality/error.hpp"
#include "nephroid/quality/exposure.hpp"
#include "nephroid/quality/reference/wave.hpp"
#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <stdexcept>
#include <vector>

namespace nephroid::tests::draw_sheets_test {

namespace {

using Vec3 = glm::vec3;
constexpr std::size_t side = 128;

using FloorMap = CausticMap<Vec3, float, PlaneChart>;

[[nodiscard]] FloorMap floor_map(std::size_t texels = side) {
    return FloorMap(PlaneChart(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), texels, texels, true));
}

[[nodiscard]] std::vector<float> picture(const FloorMap& map) {
    std::vector<float> pixels;
    for (std::size_t j = 0; j < map.chart().rows(); ++j)
        for (std::size_t i = 0; i < map.chart().columns(); ++i)
            pixels.push_back(map.texel(i, j).irradiance);
    return pixels;
}

[[nodiscard]] auto wave_buffer(std::size_t nodes, float amplitude, NodePlaces places, unsigned threads = 1) {
    ThreadExecutor executor(threads);
    return trace_buffers(PlainWave<float>{amplitude}, sun_over_square<float>(), {nodes, nodes, places}, {}, executor)
        .buffers[0];
}

[[nodiscard]] reference::Image truth(float amplitude) {
    return reference::wave({.amplitude = double(amplitude)}, {.width = int(side), .height = int(side)});
}

} // namespace

TEST_CASE("draw sheets: a folding wave on a floor without curvature or ids") {
    for (const float amplitude : {0.04f, 0.012f}) {
        FloorMap map = floor_map();
        const MapAccount account = draw_sheets(wave_buffer(71, amplitude, NodePlaces::corners), map,
                                               {.tessellation = {.bend = 0.01, .density = 0.03, .max_quads = 32}});
        const auto exact = truth(amplitude);
        // With as many nodes 0.0095 was measured at 512² texels, whose folds are sharper.
        CHECK(relative_error(picture(map), exact) < 0.01);
        CHECK(picture_error(picture(map), exact, side, side).rmse < 0.004);
        // 16384 texels, each a sum of some floats.
        CHECK(map.flux() == doctest::Approx(1).epsilon(1e-5));
        CHECK(account.cells == 70 * 70);
        CHECK(account.broken == 0);
        CHECK(account.light[Fate::splatted].flux == doctest::Approx(1).epsilon(1e-6));
        CHECK(account.light.accounted_flux() == doctest::Approx(account.light.emitted.flux).epsilon(1e-6));
    }
}

TEST_CASE("draw sheets: a map of many tiles has the same bytes with any number of threads") {
    const auto with = [](unsigned threads) {
        FloorMap map = floor_map(200);
        ThreadExecutor executor(threads);
        draw_sheets(wave_buffer(31, 0.04f, NodePlaces::corners, threads), map, {}, executor);
        return picture(map);
    };
    const auto one = with(1), two = with(2), seven = with(7);
    CHECK(std::memcmp(one.data(), two.data(), one.size() * sizeof one[0]) == 0);
    CHECK(std::memcmp(one.data(), seven.data(), one.size() * sizeof one[0]) == 0);
}

namespace {

/// A pane that bends nothing, and below it quads: a floor, walls, a tilted table, a shelf.
struct Quads {
    static constexpr bool scatters_by_chance = false;
    struct Quad {
        glm::dvec3 corner, edge_u, edge_v;
    };
    struct PlainHit {
        double distance;
        glm::dvec3 geometric_normal;
        double position_error;
        std::size_t surface;
    };
    std::vector<Quad> quads;
    double pane = 2.5; ///< its height

    [[nodiscard]] std::optional<PlainHit> intersect(const glm::dvec3& o, const glm::dvec3& d, double t_min,
                                                    double t_max) const {
        std::optional<PlainHit> nearest;
        if (const double t = (pane - o.z) / d.z; t > t_min && t < t_max)
            nearest = PlainHit{t, {0, 0, 1}, 1e-12, quads.size()};
        for (std::size_t k = 0; k < quads.size(); ++k) {
            const Quad& q = quads[k];
            const glm::dvec3 n = glm::normalize(glm::cross(q.edge_u, q.edge_v));
            const double t = glm::dot(q.corner - o, n) / glm::dot(d, n);
            const glm::dvec3 p = o + t * d - q.corner;
            const double u = glm::dot(p, q.edge_u) / glm::dot(q.edge_u, q.edge_u),
                         v = glm::dot(p, q.edge_v) / glm::dot(q.edge_v, q.edge_v);
            if (t > t_min && t < t_max && u >= 0 && u <= 1 && v >= 0 && v <= 1 && (!nearest || t < nearest->distance))
                nearest = PlainHit{t, n, 1e-12, k};
        }
        return nearest;
    }
    [[nodiscard]] Scattering<double, double> scatter(const PlainHit& hit, const glm::dvec3&, auto&) const {
        return hit.surface == quads.size() ? Scattering<double, double>::refract(1, 1)
                                           : Scattering<double, double>::deposit();
    }
};

[[nodiscard]] auto trace(const Quads& scene, const DirectionalLight<glm::dvec3, double>& light, std::size_t nodes) {
    return trace_buffers(scene, light, {nodes, nodes, NodePlaces::corners}).buffers[0];
}

[[nodiscard]] DirectionalLight<glm::dvec3, double> square_of_light(double low, double high) {
    return DirectionalLight<glm::dvec3, double>(
        {.direction = {0, 0, -1},
         .irradiance = 1,
         .patch = Parallelogram<glm::dvec3>{{low, low, 3}, {high - low, 0, 0}, {0, high - low, 0}}});
}

} // namespace

TEST_CASE(
    "draw sheets: a table tilted by 60 degrees, as lamp and camera see it, keeps its light and is half as bright") {
    // Through x = z / tan 60°: from (−1, ·, −√3) to (1, ·, √3).
    const double rise = std::sqrt(3.0);
    const Quads table{{{{-1, -1, -rise}, {2, 0, 2 * rise}, {0, 2, 0}}}};
    const auto buffer = trace(table, square_of_light(-0.5, 0.5), 33);
    const auto check = [&](const auto& chart) {
        CausticMap<glm::dvec3, double, std::decay_t<decltype(chart)>> map(chart, SeeReceiver<Quads, glm::dvec3>(table));
        const MapAccount account = draw_sheets(buffer, map);
        CHECK(account.light[Fate::splatted].flux == doctest::Approx(1));
        CHECK(map.flux() == doctest::Approx(1).epsilon(1e-3));
        const glm::dvec3 normal(-std::sin(pi<double> / 3), 0, std::cos(pi<double> / 3));
        CHECK(map.at({0.1, 0.1, 0.1 * rise}, normal) == doctest::Approx(0.5).epsilon(1e-3));
        CHECK(map.at({0.1, 0.1, 0.1 * rise}, -normal) == 0);      // the other side
        CHECK(map.at({0.1, 0.1, 0.1 * rise + 0.5}, normal) == 0); // in front of it
        CHECK(map.at({0.8, 0.1, 0.8 * rise}, normal) == 0);       // beyond the beam
    };
    check(LightChart(glm::dvec3(0, 0, 6), glm::dvec3(0), 2.5, 256));
    check(LightChart::along(glm::dvec3(0, 0, -1), glm::dvec3(0), 2.5, 256));
    check(ViewChart(glm::dvec3(-5, 1, 3), glm::dvec3(0), glm::dvec3(0, 0, 1), 0.6, 256, 256));
}

TEST_CASE("draw sheets: what the lamp's map does not see stays dark, and is counted as unseen") {
    // The map looks from below the shelf: it sees the floor, and light lands on the shelf above alone.
    const Quads shelf{{{{-1, -1, 0}, {2, 0, 0}, {0, 2, 0}}, {{-0.6, -0.6, 0.5}, {1.2, 0, 0}, {0, 1.2, 0}}}};
    const auto buffer = trace(shelf, square_of_light(-0.5, 0.5), 17);
    CausticMap<glm::dvec3, double, PlaneChart> floor(
        PlaneChart(glm::dvec3(-1, -1, 0), glm::dvec3(2, 0, 0), glm::dvec3(0, 2, 0), 64, 64));
    const MapAccount account = draw_sheets(buffer, floor);
    CHECK(floor.flux() == 0);
    CHECK(account.light[Fate::unseen].flux == doctest::Approx(1));
    CHECK(account.light[Fate::splatted].flux == 0);
}

TEST_CASE("draw sheets: light in a room of five planes is all there, on a map for each") {
    // A cube without a lid, and a beam that comes in tilted: floor and two walls are lit.
    Quads room;
    const glm::dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    room.quads = {{{0, 0, 0}, x, y}, {{0, 0, 0}, z, x}, {{0, 0, 0}, y, z}, {{1, 0, 0}, z, y}, {{0, 1, 0}, x, z}};
    room.pane = 0.9999; // above it no light reaches a wall, where it would be direct
    const DirectionalLight<glm::dvec3, double> light(
        {.direction = {0.6, 0.37, -1},
         .irradiance = 1,
         .patch = Parallelogram<glm::dvec3>{{0, 0, 1}, 0.99 * x, 0.99 * y}});
    const auto buffer = trace(room, light, 101);
    double flux = 0, seen = 0, broken = 0;
    for (const auto& quad : room.quads) {
        glm::dvec3 normal = glm::normalize(glm::cross(quad.edge_u, quad.edge_v));
        const bool faces_in = glm::dot(normal, glm::dvec3(0.5) - quad.corner) > 0;
        CausticMap<glm::dvec3, double, PlaneChart> map(faces_in
                                                           ? PlaneChart(quad.corner, quad.edge_u, quad.edge_v, 64, 64)
                                                           : PlaneChart(quad.corner, quad.edge_v, quad.edge_u, 64, 64));
        const MapAccount account = draw_sheets(buffer, map);
        flux += map.flux();
        seen += account.light[Fate::splatted].flux;
        broken = account.broken_flux;
    }
    CHECK(seen == doctest::Approx(light.power()).epsilon(1e-9));
    // A sheet's end is drawn by ellipses, of which a part hangs over the edge of its plane: about a fifth of theirs.
    CHECK(broken < 0.03 * light.power());
    CHECK(std::abs(flux - light.power()) < 0.25 * broken);
}

TEST_CASE("draw sheets: a buffer of centres and options without sense are refused") {
    FloorMap map = floor_map(8);
    CHECK_THROWS_AS(draw_sheets(wave_buffer(5, 0, NodePlaces::centres), map), std::invalid_argument);
    const auto buffer = wave_buffer(5, 0, NodePlaces::corners);
    CHECK_THROWS_AS(draw_sheets(buffer, map, {.tessellation = {.bend = 0}}), std::invalid_argument);
    CHECK_THROWS_AS(draw_sheets(buffer, map, {.broken_smoothing = -1}), std::invalid_argument);
}

} // namespace nephroid::tests::draw_sheets_test
