// SPDX-License-Identifier: MIT
#include "nephroid/image/texel_coverage.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace nephroid::tests::texel_coverage_test {

namespace {

using detail::TexelCoverage;
using detail::TexelPoint;
using Triangle = std::array<TexelPoint, 3>;

constexpr std::size_t side = 8;

[[nodiscard]] std::vector<double> areas(const Triangle& t) {
    TexelCoverage coverage;
    coverage.reset(side, side);
    for (std::size_t k = 0; k < 3; ++k)
        coverage.add_edge(t[k], t[(k + 1) % 3], 1);
    std::vector<double> found(side * side);
    coverage.visit([&](std::size_t i, std::size_t j, double area) { found[j * side + i] = area; });
    return found;
}

[[nodiscard]] double signed_area(const Triangle& t) {
    return 0.5 * ((t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[1].y - t[0].y) * (t[2].x - t[0].x));
}

[[nodiscard]] bool contains(const Triangle& t, double x, double y) {
    for (std::size_t k = 0; k < 3; ++k) {
        const TexelPoint &a = t[k], &b = t[(k + 1) % 3];
        if ((b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x) < 0)
            return false;
    }
    return true;
}

[[nodiscard]] Triangle random_triangle(std::mt19937& random, double low, double high) {
    std::uniform_real_distribution<double> uniform(low, high);
    Triangle t{};
    for (TexelPoint& p : t)
        p = {uniform(random), uniform(random)};
    if (signed_area(t) < 0)
        std::swap(t[1], t[2]);
    return t;
}

} // namespace

TEST_CASE("texel coverage: the areas of a triangle add up to its own") {
    std::mt19937 random(1);
    for (int n = 0; n < 2000; ++n) {
        const Triangle t = random_triangle(random, 0, side);
        double sum = 0;
        for (const double area : areas(t))
            sum += area;
        CHECK(std::abs(sum - signed_area(t)) < 1e-12); // 64 texels, each with a few roundings of at most 8
    }
}

TEST_CASE("texel coverage: each area is what 4096 points in the texel say") {
    std::mt19937 random(2);
    for (int n = 0; n < 40; ++n) {
        const Triangle t = random_triangle(random, -4, side + 4); // beyond the window as well
        const auto found = areas(t);
        for (std::size_t j = 0; j < side; ++j)
            for (std::size_t i = 0; i < side; ++i) {
                int inside = 0;
                for (int k = 0; k < 4096; ++k)
                    inside += int(contains(t, double(i) + (k % 64 + 0.5) / 64, double(j) + (k / 64 + 0.5) / 64));
                // Each of three sides crosses at most 128 of the small squares, half of each is in doubt.
                CHECK(std::abs(found[j * side + i] - inside / 4096.0) < 3 * 64 / 4096.0);
            }
    }
}

TEST_CASE("texel coverage: texels that a triangle does not reach get nothing at all") {
    const auto found = areas({{{2.25, 2.25}, {3.5, 2.25}, {2.25, 3.5}}});
    for (std::size_t j = 0; j < side; ++j)
        for (std::size_t i = 0; i < side; ++i)
            CHECK((found[j * side + i] > 0) == (i >= 2 && i < 4 && j >= 2 && j < 4 && i + j < 6));
}

TEST_CASE("texel coverage: slivers keep their area") {
    for (const double width : {1e-2, 1e-4, 1e-6}) {
        const Triangle t{{{0.5, 0.5}, {7.5, 6.5}, {7.5, 6.5 + width}}};
        double sum = 0;
        for (const double area : areas(t))
            sum += area;
        CHECK(std::abs(sum - 3.5 * width) < 1e-13);
    }
}

TEST_CASE("texel coverage: a point adds to its own texel, and outside of the window to none") {
    TexelCoverage coverage;
    coverage.reset(2, 2);
    coverage.add_point({1.5, 0.5}, 3);
    coverage.add_point({-0.1, 0.5}, 5);
    coverage.add_point({2, 0.5}, 7);
    coverage.visit([](std::size_t i, std::size_t j, double amount) {
        CHECK(i == 1);
        CHECK(j == 0);
        CHECK(amount == 3);
    });
}

} // namespace nephroid::tests::texel_coverage_test
