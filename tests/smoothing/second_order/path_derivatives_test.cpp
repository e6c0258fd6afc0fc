// SPDX-License-Identifier: MIT
#include "nephroid/smoothing/second_order/path_derivatives.hpp"

#include "support/space.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace nephroid::tests::path_derivatives_test {

using namespace nephroid::detail;
using tests::Draws;
using tests::Space;
using tests::Wide;

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

[[nodiscard]] Double3 any_space(Draws& draw) { return {draw.in(-1, 1), draw.in(-1, 1), draw.in(-1, 1)}; }

[[nodiscard]] double distance(const Double3& a, const Double3& b) { return std::sqrt(inner(a - b, a - b)); }

/// A cubic map: its tangents are quadratic.
struct Cubic {
    PathDerivatives at_zero;

    explicit Cubic(Draws& draw) {
        for (Double3& v : at_zero.first)
            v = any_space(draw);
        for (Double3& v : at_zero.second)
            v = any_space(draw);
        for (Double3& v : at_zero.third)
            v = any_space(draw);
    }

    [[nodiscard]] std::array<Double3, 2> tangents(Plane2 at) const {
        const auto& [j, h, t] = at_zero;
        const double xx = 0.5 * at.x * at.x, xy = at.x * at.y, yy = 0.5 * at.y * at.y;
        return {j[0] + at.x * h[0] + at.y * h[1] + (xx * t[0] + xy * t[1] + yy * t[2]),
                j[1] + at.x * h[1] + at.y * h[2] + (xx * t[1] + xy * t[2] + yy * t[3])};
    }
};

[[nodiscard]] double furthest_first(const PathDerivatives& a, const PathDerivatives& b) {
    return (std::max)(distance(a.first[0], b.first[0]), distance(a.first[1], b.first[1]));
}
[[nodiscard]] double furthest_second(const PathDerivatives& a, const PathDerivatives& b) {
    double most = 0;
    for (std::size_t i = 0; i < 3; ++i)
        most = (std::max)(most, distance(a.second[i], b.second[i]));
    return most;
}
[[nodiscard]] double furthest_third(const PathDerivatives& a, const PathDerivatives& b) {
    double most = 0;
    for (std::size_t i = 0; i < 4; ++i)
        most = (std::max)(most, distance(a.third[i], b.third[i]));
    return most;
}

} // namespace

// The normal matrix of 8 to 30 photons in a square, scaled to a unit diagonal, has pivots above 1e-4: a condition of
// 1e6 at the very most, which makes 1e6 ε of numbers below 10.
TEST_CASE("path derivatives: a cubic map is fitted exactly wherever its photons lie") {
    Draws draw(7);
    for (int round = 0; round < 100; ++round) {
        const Cubic map(draw);
        PathFit fit;
        const int photons = 8 + round % 23;
        for (int i = 0; i < photons; ++i) {
            const Plane2 at{draw.in(-1.5, 1.5), draw.in(-1.5, 1.5)};
            fit.add(at, map.tangents(at), draw.in(0.1, 1));
        }
        PathDerivatives fitted;
        REQUIRE(fit.solve(fitted));
        CAPTURE(photons);
        CHECK(furthest_first(fitted, map.at_zero) <= 1e7 * epsilon);
        CHECK(furthest_second(fitted, map.at_zero) <= 1e7 * epsilon);
        CHECK(furthest_third(fitted, map.at_zero) <= 1e7 * epsilon);
    }
}

TEST_CASE("path derivatives: the scale of the displacements and of the weights does not matter") {
    for (const double scale : {1e-6, 1.0, 1e6}) {
        Draws draw(8);
        Cubic map(draw);
        PathFit fit;
        for (int i = 0; i < 20; ++i) {
            const Plane2 at{draw.in(-1, 1), draw.in(-1, 1)};
            fit.add(scale * at, map.tangents(at), 1e-9);
        }
        PathDerivatives fitted;
        REQUIRE(fit.solve(fitted));
        for (Double3& v : fitted.second)
            v = scale * v;
        for (Double3& v : fitted.third)
            v = scale * scale * v;
        CAPTURE(scale);
        CHECK(furthest_first(fitted, map.at_zero) <= 1e7 * epsilon);
        CHECK(furthest_second(fitted, map.at_zero) <= 1e7 * epsilon);
        CHECK(furthest_third(fitted, map.at_zero) <= 1e7 * epsilon);
    }
}

TEST_CASE("path derivatives: few photons determine the second derivatives only") {
    Draws draw(9);
    Cubic map(draw);
    map.at_zero.third = {};
    for (int photons = 4; photons < 8; ++photons) {
        PathFit fit;
        for (int i = 0; i < photons; ++i) {
            const Plane2 at{draw.in(-1, 1), draw.in(-1, 1)};
            fit.add(at, map.tangents(at), 1);
        }
        PathDerivatives fitted;
        REQUIRE(fit.solve(fitted));
        CAPTURE(photons);
        CHECK(furthest_first(fitted, map.at_zero) <= 1e5 * epsilon);
        CHECK(furthest_second(fitted, map.at_zero) <= 1e5 * epsilon);
        for (const Double3& t : fitted.third)
            CHECK(inner(t, t) == 0);
    }
}

// Two lines cross but do not span the quadratic terms of nine unknowns: the five others are still to be had.
TEST_CASE("path derivatives: photons on a line are refused and undetermined third derivatives are zero") {
    Draws draw(10);
    Cubic map(draw);
    PathDerivatives fitted;
    CHECK(!PathFit{}.solve(fitted));
    PathFit few;
    for (const Plane2 at : {Plane2{0, 0}, Plane2{1, 0}, Plane2{0, 1}})
        few.add(at, map.tangents(at), 1);
    CHECK(!few.solve(fitted));

    for (const Plane2 along : {Plane2{1, 0}, Plane2{0, 1}, Plane2{0.6, 0.8}}) {
        PathFit line;
        for (int i = 0; i < 30; ++i) {
            const Plane2 at = draw.in(-1, 1) * along;
            line.add(at, map.tangents(at), 1);
        }
        CHECK(!line.solve(fitted));
    }
    PathFit point;
    for (int i = 0; i < 30; ++i)
        point.add({0, 0}, map.tangents({0, 0}), 1);
    CHECK(!point.solve(fitted));

    map.at_zero.third = {};
    PathFit corners; // x² and y² are 1 in all of them: nothing is told apart from the tangents themselves
    for (int i = 0; i < 12; ++i) {
        const Plane2 at{i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0};
        corners.add(at, map.tangents(at), 1);
    }
    REQUIRE(corners.solve(fitted));
    CHECK(furthest_second(fitted, map.at_zero) <= 1e3 * epsilon);
    for (const Double3& t : fitted.third)
        CHECK(inner(t, t) == 0);
}

TEST_CASE("path derivatives: second derivatives in other axes are those of the rotated map") {
    Draws draw(12);
    const Cubic map(draw);
    const PlaneMatrix axes{{draw.in(-1, 1), draw.in(-1, 1)}, {draw.in(-1, 1), draw.in(-1, 1)}};
    const auto second = rotated(map.at_zero.second, axes);
    // F(axes v): its tangents by v are the map's, combined; H by differences, exact as the third order is left out.
    Cubic quadratic = map;
    quadratic.at_zero.third = {};
    const auto tangents = [&](Plane2 v) {
        const auto t = quadratic.tangents(axes(v));
        return std::array<Double3, 2>{axes.first.x * t[0] + axes.first.y * t[1],
                                      axes.second.x * t[0] + axes.second.y * t[1]};
    };
    const auto zero = tangents({0, 0}), right = tangents({1, 0}), up = tangents({0, 1});
    CHECK(distance(second[0], right[0] - zero[0]) <= 32 * epsilon);
    CHECK(distance(second[1], right[1] - zero[1]) <= 32 * epsilon);
    CHECK(distance(second[1], up[0] - zero[0]) <= 32 * epsilon);
    CHECK(distance(second[2], up[1] - zero[1]) <= 32 * epsilon);
    const auto same = rotated(map.at_zero.second, {{1, 0}, {0, 1}});
    for (std::size_t i = 0; i < 3; ++i)
        CHECK(distance(same[i], map.at_zero.second[i]) == 0);
}

namespace {

/// Where light that comes straight down at (u, v) meets the floor z = −1.25 below a unit ball of index 1.5 about the
/// origin, in wide precision: Snell's law by angles, no formula of the library's.
[[nodiscard]] Space under_ball(const Wide& u, const Wide& v) {
    const Wide one(1), index(1.5);
    const Space down{Wide(0), Wide(0), Wide(-1)};
    const Space in = tests::on_sphere({u, v, Wide(2)}, down, one, false);
    const Space inside = tests::bent(down, in.unit(), one / index);
    const Space out = tests::on_sphere(in, inside, one, true);
    const Space d = tests::bent(inside, Wide(-1) * out.unit(), index);
    return tests::on_plane(out, d, {Wide(0), Wide(0), Wide(-1.25)}, {Wide(0), Wide(0), one});
}

/// Central differences of steps h, in wide precision: wrong by h² alone.
struct Differences {
    Wide h{1e-7};
    [[nodiscard]] Space first(double u, double v, int axis) const {
        const Wide du = axis == 0 ? h : Wide(0), dv = axis == 0 ? Wide(0) : h;
        return Wide(0.5) / h * (under_ball(Wide(u) + du, Wide(v) + dv) - under_ball(Wide(u) - du, Wide(v) - dv));
    }
    [[nodiscard]] Space second(double u, double v, int which) const { // uu, uv, vv
        const Wide x(u), y(v);
        if (which == 1)
            return Wide(0.25) / (h * h) *
                   ((under_ball(x + h, y + h) - under_ball(x + h, y - h)) -
                    (under_ball(x - h, y + h) - under_ball(x - h, y - h)));
        const Wide du = which == 0 ? h : Wide(0), dv = which == 0 ? Wide(0) : h;
        return Wide(1) / (h * h) *
               ((under_ball(x + du, y + dv) - under_ball(x, y)) - (under_ball(x, y) - under_ball(x - du, y - dv)));
    }
};

[[nodiscard]] Double3 narrowed(const Space& v) {
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

/// How far off H is where 25 photons lie on a square of this side, relative to the largest of it.
[[nodiscard]] double error_of_second(double side) {
    double worst = 0, largest = 0;
    const Differences differences;
    for (const Plane2 middle : {Plane2{0.1, 0.2}, Plane2{-0.3, 0.25}, Plane2{0.4, -0.1}}) {
        PathFit fit;
        for (int i = -2; i <= 2; ++i)
            for (int j = -2; j <= 2; ++j) {
                const Plane2 at{side * i / 4, side * j / 4};
                const double u = middle.x + at.x, v = middle.y + at.y;
                fit.add(at, {narrowed(differences.first(u, v, 0)), narrowed(differences.first(u, v, 1))},
                        1.0 / (1 + i * i + j * j));
            }
        PathDerivatives fitted;
        REQUIRE(fit.solve(fitted));
        for (int which = 0; which < 3; ++which) {
            const Double3 exact = narrowed(differences.second(middle.x, middle.y, which));
            worst = (std::max)(worst, distance(fitted.second[std::size_t(which)], exact));
            largest = (std::max)(largest, std::sqrt(inner(exact, exact)));
        }
    }
    return worst / largest;
}

} // namespace

#if defined(__SIZEOF_FLOAT128__) // else the differences have no digits left
// What the fit leaves out of J is of third order, so H is off by the square of the photons' distance, which falls with
// their number N like 1/N. The next order is that square again times the ball's own scale: below 0.1 here.
TEST_CASE("path derivatives: under a ball of glass they converge to central differences as photons get denser") {
    std::vector<double> errors;
    for (const double side : {0.04, 0.02, 0.01, 0.005})
        errors.push_back(error_of_second(side));
    CAPTURE(errors[0]);
    CAPTURE(errors[1]);
    CAPTURE(errors[2]);
    CAPTURE(errors[3]);
    CHECK(errors[0] < 0.05);
    for (std::size_t i = 1; i < errors.size(); ++i) {
        const double order = std::log2(errors[i - 1] / errors[i]);
        CAPTURE(order);
        CHECK(std::abs(order - 2) < 0.2);
    }
}
#endif

} // namespace nephroid::tests::path_derivatives_test
