// SPDX-License-Identifier: MIT
#include "nephroid/image/map_patch.hpp"

#include "nephroid/image/projected_chart.hpp"
#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>

#include <glm/vec3.hpp>

#include <cmath>
#include <functional>

namespace nephroid::tests::map_patch_test {

namespace {

using Vec3 = glm::dvec3;
using detail::Double3;

constexpr std::size_t side = 16;

[[nodiscard]] PlaneChart chart() { return PlaneChart(Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0), side, side); }

/// A patch through a map of the unit square, with its derivatives by differences.
[[nodiscard]] detail::LitPatch<Vec3, double> patch_of(const std::function<Double3(double, double)>& f) {
    detail::LitPatch<Vec3, double> patch{};
    const double h = 1e-6;
    for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t j = 0; j < 2; ++j) {
            const double u = double(i), v = double(j);
            patch.corners[i][j] = {f(u, v), (0.5 / h) * (f(u + h, v) - f(u - h, v)),
                                   (0.5 / h) * (f(u, v + h) - f(u, v - h))};
            patch.normal[i][j] = {0, 0, 1};
        }
    patch.flux = 1;
    return patch;
}

struct Moments {
    double flux = 0, x = 0, y = 0;
};

[[nodiscard]] Moments moments(const detail::LitPatch<Vec3, double>& patch) {
    const auto made = detail::map_patch(patch, {.bend = 0.01, .density = 0.02, .max_quads = 32}, chart());
    detail::PatchTexels texels;
    Moments m;
    const double area = 1.0 / double(side * side);
    texels.cover(made, detail::RasterWindow{0, 0, side, side, 0, 0}, chart())
        .visit([&](std::size_t i, std::size_t j, double e) {
            m.flux += e * area;
            m.x += e * area * (double(i) + 0.5) / side, m.y += e * area * (double(j) + 0.5) / side;
        });
    return m;
}

} // namespace

TEST_CASE("map patch: the flux of flat, bent, folded and collapsed patches is all on the texels") {
    const auto flat = [](double u, double v) { return Double3{0.2 + 0.5 * u + 0.1 * v, 0.3 + 0.4 * v, 0}; };
    const auto folded = [](double u, double v) { return Double3{0.2 + 0.9 * u * (1 - u), 0.3 + 0.4 * v, 0}; };
    const auto line = [](double u, double v) { return Double3{0.2 + 0.5 * u, 0.3 + 0.3 * u + 0 * v, 0}; };
    const auto point = [](double u, double v) { return Double3{0.2 + 0 * u, 0.3 + 0 * v, 0}; };
    const auto tiny = [](double u, double v) { return Double3{0.51 + 1e-4 * u, 0.3 + 1e-4 * v, 0}; };
    for (const std::function<Double3(double, double)>& f :
         {std::function<Double3(double, double)>(flat), std::function<Double3(double, double)>(folded),
          std::function<Double3(double, double)>(line), std::function<Double3(double, double)>(point),
          std::function<Double3(double, double)>(tiny)}) {
        // Sums of areas with weights of up to 1e8, in double.
        CHECK(std::abs(moments(patch_of(f)).flux - 1) < 1e-8);
    }
}

TEST_CASE("map patch: a fold's light lies where its map puts it") {
    // x = 0.2 + 0.9 u (1 − u) with u uniform: its mean is 0.2 + 0.15. A texel's light counts at its
    // middle, which is off by up to half a texel, 1/32, but on average over the smooth part by nothing.
    const Moments m = moments(patch_of([](double u, double v) {
        return Double3{0.2 + 0.9 * u * (1 - u), 0.3 + 0.4 * v, 0};
    }));
    CHECK(std::abs(m.x - 0.35) < 0.005);
    CHECK(std::abs(m.y - 0.5) < 0.005);
}

TEST_CASE("map patch: a patch that the chart does not see has an empty box") {
    auto patch = patch_of([](double u, double v) { return Double3{u, v, 0}; });
    patch.corners[1][1].position = {std::nan(""), 0, 0};
    CHECK(detail::map_patch(patch, {}, chart()).box.x0 > detail::map_patch(patch, {}, chart()).box.x1);
    auto edge_on = patch_of([](double u, double v) { return Double3{u, 0.5, v}; });
    for (auto& row : edge_on.normal)
        row = {Double3{0, 1, 0}, Double3{0, 1, 0}};
    const auto made = detail::map_patch(edge_on, {}, chart());
    CHECK(made.box.x0 > made.box.x1);
}

} // namespace nephroid::tests::map_patch_test
