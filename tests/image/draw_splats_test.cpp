// SPDX-License-Identifier: MIT
#include "nephroid/image/draw_splats.hpp"

#include "nephroid/execution/thread_executor.hpp"
#include "nephroid/image/projected_chart.hpp"
#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>

#include <glm/vec3.hpp>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

namespace nephroid::tests::draw_splats_test {

namespace {

using Vec3 = glm::dvec3;
using Photon = Deposit<Vec3, double, 2>;
using FloorMap = CausticMap<Vec3, double, PlaneChart>;

[[nodiscard]] FloorMap floor_map(std::size_t side = 64, bool repeats = false) {
    return FloorMap(PlaneChart(Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0), side, side, repeats));
}

[[nodiscard]] Photon photon(const Vec3& at, const Vec3& a, const Vec3& b, double flux = 1) {
    return {at, {0, 0, 1}, {0, 0, -1}, flux, {a, b}};
}

} // namespace

TEST_CASE("draw splats: a footprint's flux, middle and spread are those of its ellipse and a texel's box") {
    FloorMap map = floor_map(128);
    const Vec3 a(0.3, 0.1, 0), b(-0.05, 0.2, 0);
    draw_splats(std::vector{photon({0.48, 0.52, 0}, a, b)}, map, {.smoothing = 1});
    double flux = 0, x = 0, xx = 0, xy = 0;
    for (std::size_t j = 0; j < 128; ++j)
        for (std::size_t i = 0; i < 128; ++i) {
            const double part = map.texel(i, j).irradiance / (128.0 * 128.0), px = (double(i) + 0.5) / 128 - 0.48,
                         py = (double(j) + 0.5) / 128 - 0.52;
            flux += part, x += part * px, xx += part * px * px, xy += part * px * py;
        }
    // The kernel has two derivatives' worth of smoothness at its edge, over some 20 texels: the sum is its integral.
    CHECK(flux == doctest::Approx(1).epsilon(1e-4));
    CHECK(std::abs(x) < 1e-5);
    const double m2 = 1.0 / 8; // the biweight's, of semi-axes a/2 and b/2
    CHECK(xx == doctest::Approx(m2 * (a.x * a.x + b.x * b.x) / 4 + 1 / (12 * 128.0 * 128.0)).epsilon(1e-3));
    CHECK(xy == doctest::Approx(m2 * (a.x * a.y + b.x * b.y) / 4).epsilon(1e-3));
}

TEST_CASE("draw splats: a pattern that repeats gets back what leaves it") {
    FloorMap map = floor_map(64, true);
    draw_splats(std::vector{photon({-0.01, 1.02, 0}, {0.2, 0, 0}, {0, 0.2, 0})}, map, {.smoothing = 1});
    CHECK(map.flux() == doctest::Approx(1).epsilon(1e-3));
    CHECK(map.texel(0, 0).irradiance > 0);
    CHECK(map.texel(63, 63).irradiance > 0);
    CHECK(map.texel(32, 32).irradiance == 0);
}

TEST_CASE("draw splats: light above a pattern that repeats is left out over each of its tiles") {
    for (const double x : {0.5, 1.5, -3.5}) {
        FloorMap map = floor_map(64, true);
        const Statistics account =
            draw_splats(std::vector{photon({x, 0.5, 5}, {0.2, 0, 0}, {0, 0.2, 0})}, map, {.smoothing = 1});
        CHECK(account[Fate::unseen].photons == 1);
        CHECK(map.flux() == 0);
    }
}

TEST_CASE("draw splats: all photons are counted, and none makes a texel that is no number") {
    const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
    FloorMap map = floor_map();
    const Vec3 a(0.1, 0, 0), b(0, 0.1, 0);
    const std::vector<Photon> photons{
        photon({0.5, 0.5, 0}, a, b), photon({0.5, 0.5, 0.4}, a, b),         photon({7, 0.5, 0}, a, b),
        photon({nan, 0.5, 0}, a, b), photon({0.5, 0.5, 0}, {inf, 0, 0}, b), photon({0.5, 0.5, 0}, a, b, nan)};
    const Statistics account = draw_splats(photons, map, {.smoothing = 1});
    CHECK(account[Fate::splatted].photons == 1);
    CHECK(account[Fate::unseen].photons == 2); // above the floor, beside it
    CHECK(account[Fate::invalid].photons == 3);
    CHECK(account.accounted_flux() == 5);
    CHECK(map.flux() == doctest::Approx(1).epsilon(1e-2));
    FloorMap empty = floor_map();
    CHECK(draw_splats(std::vector<Photon>{}, empty).accounted_flux() == 0);
    // Without an area the pixel filter is all there is. Its disk is narrower than a texel, so texels sample it badly,
    // but with the right mean over where it may lie.
    std::vector<Photon> points;
    for (int k = 0; k < 1024; ++k)
        points.push_back(
            photon({(32 + (k % 32 + 0.5) / 32) / 64, (32 + (k / 32 + 0.5) / 32) / 64, 0}, {}, {}, 1.0 / 1024));
    draw_splats(points, empty);
    CHECK(empty.flux() == doctest::Approx(1).epsilon(1e-3));
}

TEST_CASE("draw splats: the map has the same bytes with any number of threads") {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> at(0, 1), size(-0.1, 0.1);
    std::vector<Photon> photons;
    for (int n = 0; n < 2000; ++n)
        photons.push_back(
            photon({at(random), at(random), 0}, {size(random), size(random), 0}, {size(random), size(random), 0}));
    const auto with = [&](unsigned threads) {
        FloorMap map = floor_map(150);
        ThreadExecutor executor(threads);
        draw_splats(photons, map, {.smoothing = 1}, executor);
        std::vector<double> pixels;
        for (std::size_t j = 0; j < 150; ++j)
            for (std::size_t i = 0; i < 150; ++i)
                pixels.push_back(map.texel(i, j).irradiance);
        return pixels;
    };
    const auto one = with(1), five = with(5);
    CHECK(std::memcmp(one.data(), five.data(), one.size() * sizeof one[0]) == 0);
}

TEST_CASE("draw splats: a smoothing or a filter without sense is refused") {
    FloorMap map = floor_map(4);
    const std::vector<Photon> none;
    CHECK_THROWS_AS(draw_splats(none, map, {.smoothing = 0}), std::invalid_argument);
    CHECK_THROWS_AS(draw_splats(none, map, {.filter_width = -1}), std::invalid_argument);
}

} // namespace nephroid::tests::draw_splats_test
