// SPDX-License-Identifier: MIT
#include "nephroid/receiver/spacing.hpp"

#include "support/space.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

namespace nephroid::tests::spacing_test {

using detail::point_spacing;
using tests::Draws;
using tests::Space;
using tests::Wide;

namespace {

template <class T>
struct Points {
    std::vector<T> x, y, z;

    void add(const Space& p) {
        x.push_back(static_cast<T>(p.x));
        y.push_back(static_cast<T>(p.y));
        z.push_back(static_cast<T>(p.z));
    }
    [[nodiscard]] double spacing() const { return double(point_spacing<T>(x, y, z)); }
};

/// columns x rows points, this far apart, in the plane of u and v.
template <class T>
Points<T> lattice(int columns, int rows, double side_u, double side_v, const Space& u = {1, 0, 0},
                  const Space& v = {0, 1, 0}) {
    Points<T> points;
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i)
            points.add(Wide(i * side_u) * u + Wide(j * side_v) * v);
    return points;
}

template <class T>
constexpr double epsilon = double(std::numeric_limits<T>::epsilon());

} // namespace

// With a side that is a power of two every squared distance is exact, so is their sum, and 12 p² / 12: the root of
// p².
TEST_CASE_TEMPLATE("point spacing: the spacing of a square lattice is its side", T, float, double) {
    for (const auto& size : {std::pair{8, 8}, {4, 8}, {5, 5}, {7, 4}, {6, 6}, {4, 4}})
        for (const double side : {1.0, 0.25, 1024.0}) {
            CAPTURE(size.first);
            CAPTURE(size.second);
            CHECK(lattice<T>(size.first, size.second, side, side).spacing() == side);
        }
}

// Coordinates up to 8 p in three axes are rounded by 8 p epsilon/2 each: a distance of p is off by 8 sqrt(3) epsilon p.
TEST_CASE_TEMPLATE("point spacing: the orientation of a lattice does not matter", T, float, double) {
    Draws draw(41);
    for (int i = 0; i < 50; ++i) {
        const Space n = draw.direction(), u = draw.direction().across(n).unit(), v = n.cross(u);
        const double side = draw.in(0.01, 30);
        CHECK(std::abs(lattice<T>(8, 8, side, side, u, v).spacing() - side) <= 16 * epsilon<T> * side);
    }
}

TEST_CASE("point spacing: the spacing of a stretched lattice is between its two sides") {
    for (const double stretch : {1.2, 2.0, 3.0, 5.0}) {
        const double spacing = lattice<double>(8, 8, 1, stretch).spacing();
        CAPTURE(stretch);
        CHECK(spacing > 1);
        CHECK(spacing < stretch);
        CHECK(std::abs(lattice<double>(8, 8, stretch, 1).spacing() - spacing) <= 1e-12);
    }
    // Twice as high as wide the eight nearest are at 1 1 2 2 and 2 2, then √5: 2 (1 + 4 + 4) + 2 · 5 over 12.
    CHECK(std::abs(lattice<double>(9, 9, 1, 2).spacing() - std::sqrt(28.0 / 12)) <= 1e-12);
}

// The four in the middle of an 8 x 8 lattice are asked, and their median counts. With a neighbour gone, one of them
// says (12 − 2 + 4) / 12 and three say 1. With a stray at (−0.1, −0.1) from it, in the place of a neighbour at
// √2, it says (12 − 2 + 0.02) / 12, the two next to it, with the stray at √1.22, (12 − 2 + 1.22) / 12, and the
// fourth 1.
TEST_CASE_TEMPLATE("point spacing: a hole or a stray point beside the middle hardly matters", T, float, double) {
    const auto without = [](double x, double y) {
        Points<T> points;
        for (int i = 0; i < 64; ++i)
            if (i % 8 != x || i / 8 != y)
                points.add({double(i % 8), double(i / 8), 0});
        return points;
    };
    CHECK(without(2, 2).spacing() == 1);
    Points<T> stray = without(-1, -1);
    stray.add({2.9, 2.9, 0});
    // 2.9 is rounded by 2 halves of epsilon, times 1.1 twice over, in 12; sums and root round by a few.
    CHECK(std::abs(stray.spacing() - std::sqrt(11.22 / 12)) <= 8 * epsilon<T>);
}

// The k-th nearest of randomly strewn points of density 1 has the mean squared distance k/π: 36/π over 12 is 0.977².
// The root of an average is below the average's root, and the median below the mean: the documented 0.95. Of 400 clouds
// the mean varies by about 0.2/sqrt(400) = 0.01: four of these.
TEST_CASE_TEMPLATE("point spacing: the spacing of random points is 0.95 over the root of their density", T, float,
                   double) {
    Draws draw(42);
    double sum = 0;
    for (int cloud = 0; cloud < 400; ++cloud) {
        Points<T> points;
        for (int i = 0; i < 256; ++i)
            points.add({draw.in(0, 16), draw.in(0, 16), 2});
        sum += points.spacing();
    }
    CHECK(std::abs(sum / 400 - 0.95) <= 0.04);
}

TEST_CASE_TEMPLATE("point spacing: two points have a spacing and one has none", T, float, double) {
    CHECK(Points<T>{}.spacing() == 0);
    CHECK(lattice<T>(1, 1, 1, 1).spacing() == 0);
    CHECK(lattice<T>(2, 1, 0.5, 1).spacing() == 0.5);
    CHECK(lattice<T>(2, 2, 1, 1).spacing() == doctest::Approx(std::sqrt(4.0 / 3))); // 1, 1, 2 over 3
    for (int n = 2; n <= 12; ++n) {
        const double row = lattice<T>(n, 1, 1, 1).spacing();
        CAPTURE(n);
        CHECK(std::isfinite(row));
        CHECK(row >= 1);
        CHECK(row <= n);
    }
}

TEST_CASE_TEMPLATE("point spacing: coincident points have spacing zero and duplicates change nothing", T, float,
                   double) {
    Points<T> coincident, twice;
    for (int i = 0; i < 64; ++i)
        coincident.add({3, 4, 5});
    CHECK(coincident.spacing() == 0);
    for (int copy = 0; copy < 2; ++copy)
        for (int i = 0; i < 36; ++i)
            twice.add({double(i % 6), double(i / 6), 0});
    CHECK(twice.spacing() == 1);
}

} // namespace nephroid::tests::spacing_test
