// SPDX-License-Identifier: MIT
#include "common/study/image/command.hpp"
#include "common/study/image/waves.hpp"

#include "nephroid/image/trace_buffer.hpp"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>

#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

namespace nephroid::examples::study::image_test {

namespace {

using namespace nephroid::examples::study::image;

/// Flat water: photons land below where they start, on a grid of 32² over 64² texels.
[[nodiscard]] GridScene still_water() {
    const WaterWaves water({});
    const std::size_t side = 32;
    auto corners = trace_buffers(water, sun_over_square(), {side + 1, side + 1, NodePlaces::corners});
    const auto centres = trace_buffers(water, sun_over_square(), {side, side});
    GridScene scene{PlaneChart(glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), 64, 64, true),
                    1,
                    std::move(corners.buffers.at(0)),
                    neighbour_tangents(centres.buffers.at(0)).deposits,
                    {},
                    1.0 / double(side * side)};
    scene.lenses.assign(scene.photons.size(), {0, 1});
    return scene;
}

} // namespace

TEST_CASE("study image: water's slopes and curvatures are its derivatives") {
    const WaterWaves water({{0.02, 2, 1, 0.3, 1}, {0.01, -1, 3, 1, 0}}, 0.7);
    const double x = 0.3, y = 0.6, h = 1e-4; // errors of h² times derivatives of up to (2π 3)⁴ · 0.01
    const auto z = [&](double dx, double dy) { return water.at(x + dx, y + dy).z; };
    const auto s = water.at(x, y);
    CHECK(s.x == doctest::Approx((z(h, 0) - z(-h, 0)) / (2 * h)).epsilon(1e-5));
    CHECK(s.y == doctest::Approx((z(0, h) - z(0, -h)) / (2 * h)).epsilon(1e-5));
    CHECK(s.xx == doctest::Approx((z(h, 0) - 2 * z(0, 0) + z(-h, 0)) / (h * h)).epsilon(1e-4));
    CHECK(s.xy == doctest::Approx((z(h, h) - z(h, -h) - z(-h, h) + z(-h, -h)) / (4 * h * h)).epsilon(1e-4));
    // A crest of a sine with slope 0: half of amplitude (2π)² |k|².
    const auto crest = WaterWaves({{0.02, 2, 1}}).at(0.125, 0);
    CHECK(crest.mean_curvature() == doctest::Approx(0.5 * 0.02 * 4 * pi<double> * pi<double> * 5));
}

TEST_CASE("study image: below still water every method draws an even light of 1") {
    const GridScene scene = still_water();
    for (const RasterMethod& method : raster_methods()) {
        // With s = 3 a biweight kernel on a square lattice is even to a few parts in a thousand.
        const double s = method.s_most <= 2 ? 1 : method.s_least < method.s_most ? 3 : 1;
        CAPTURE(method.title);
        for (const float e : method.picture(scene, s))
            CHECK(std::abs(e - 1) < 0.02f);
    }
}

TEST_CASE("study image: a thin lens in focus is a point, and beyond it as large as before it") {
    GridScene scene = still_water();
    const RasterMethod& lens = raster_methods()[2];
    REQUIRE(lens.title.starts_with("thin lens"));
    scene.lenses.assign(scene.photons.size(), {1, 0});
    const auto before = lens.picture(scene, 2);
    scene.lenses.assign(scene.photons.size(), {1, 2}); // 1 − 2 is as large as 1 − 0
    CHECK(lens.picture(scene, 2) == before);
    scene.lenses.assign(scene.photons.size(), {1, 1});
    const auto points = lens.picture(scene, 2);
    // What is left is the pixel filter's disk of radius² 2/3 texels. Photons lie between four texels each, with
    // middles
    // are sqrt(1/2) away: 4 texels a photon times the biweight at 3/4, over the disk's square.
    const double expected = 4 * 3 / pi<double> * square(0.25) / (2.0 / 3);
    for (const float e : points)
        CHECK(double(e) == doctest::Approx(expected).epsilon(1e-4));
}

TEST_CASE("study image: moving water's flicker is small for sheets, and larger for what the papers do") {
    const Table table = flicker_table({.frames = 6, .size = 32, .nodes = 48, .truth = 192, .step = 0.03, .strip = ""});
    REQUIRE(table.rows.size() == 2 * raster_methods().size());
    const auto flicker = [&](std::size_t row) { return std::atof(table.rows[row][3].c_str()); };
    const double sheets = flicker(raster_methods().size() - 1);
    for (std::size_t row = 0; row + 2 < raster_methods().size(); ++row) {
        CAPTURE(table.rows[row][0]);
        CHECK(sheets < flicker(row));
    }
}

} // namespace nephroid::examples::study::image_test
