// SPDX-License-Identifier: MIT
#include "nephroid/vector/plane.hpp"

#include "support/space.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace nephroid::tests::plane_test {

using detail::congruent;
using detail::Plane2;
using detail::PlaneMatrix;
using detail::Principal2;
using detail::Symmetric2;
using tests::Draws;

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

[[nodiscard]] PlaneMatrix any_matrix(Draws& draw) {
    return {{draw.in(-2, 2), draw.in(-2, 2)}, {draw.in(-2, 2), draw.in(-2, 2)}};
}

[[nodiscard]] Symmetric2 any_symmetric(Draws& draw) { return {draw.in(-2, 2), draw.in(-2, 2), draw.in(-2, 2)}; }

void check_same(const Symmetric2& a, const Symmetric2& b, double tolerance) {
    CHECK(std::abs(a.xx - b.xx) <= tolerance);
    CHECK(std::abs(a.xy - b.xy) <= tolerance);
    CHECK(std::abs(a.yy - b.yy) <= tolerance);
}

void check_same(Plane2 a, Plane2 b, double tolerance) {
    CHECK(std::abs(a.x - b.x) <= tolerance);
    CHECK(std::abs(a.y - b.y) <= tolerance);
}

} // namespace

TEST_CASE("plane: a symmetric matrix is what it says of itself") {
    const Symmetric2 m{2, 3, 5};
    CHECK(m.trace() == 7);
    CHECK(m.determinant() == 1);
    check_same(m({1, 2}), {8, 13}, 0);
    check_same(Symmetric2::outer({2, -3}), {4, -6, 9}, 0);
    check_same(Symmetric2::isotropic(4), {4, 0, 4}, 0);
    Symmetric2 sum = m;
    sum += 2 * Symmetric2{1, 1, 1};
    check_same(sum, {4, 5, 7}, 0);
}

TEST_CASE("plane: a matrix by its columns and its inverse by hand") {
    const PlaneMatrix m{{2, 1}, {5, 3}}; // rows 2 5, 1 3
    CHECK(m.determinant() == 1);
    check_same(m({1, 10}), {52, 31}, 0);
    const PlaneMatrix inverse = m.inverse();
    check_same(inverse.first, {3, -1}, 0);
    check_same(inverse.second, {-5, 2}, 0);
    const PlaneMatrix turned = m.transposed();
    check_same(turned.first, {2, 5}, 0);
    check_same(turned.second, {1, 3}, 0);
}

// Entries below 2: a product rounds by less than 16 ε; dividing by a determinant d makes ε/d² of that at most.
TEST_CASE("plane: a matrix times its inverse is one") {
    Draws draw(3);
    for (int i = 0; i < 1000; ++i) {
        const PlaneMatrix m = any_matrix(draw);
        const double d = m.determinant();
        if (std::abs(d) < 0.01)
            continue;
        const PlaneMatrix one = m * m.inverse();
        check_same(one.first, {1, 0}, 64 * epsilon / (d * d));
        check_same(one.second, {0, 1}, 64 * epsilon / (d * d));
    }
}

TEST_CASE("plane: a product of matrices does one after the other") {
    Draws draw(4);
    for (int i = 0; i < 100; ++i) {
        const PlaneMatrix a = any_matrix(draw), b = any_matrix(draw);
        const Plane2 v{draw.in(-2, 2), draw.in(-2, 2)};
        check_same((a * b)(v), a(b(v)), 64 * epsilon * 8);
        CHECK(std::abs((a * b).determinant() - a.determinant() * b.determinant()) <= 64 * epsilon * 64);
    }
}

// v' (M S M') w = (M' v)' S (M' w): another way to the same number.
TEST_CASE("plane: a congruent tensor measures what the tensor measures through the matrix") {
    check_same(congruent({{0, 1}, {-1, 0}}, {2, 3, 5}), {5, -3, 2}, 0); // a quarter turn
    check_same(congruent({{2, 0}, {0, 3}}, {2, 3, 5}), {8, 18, 45}, 0);
    Draws draw(5);
    for (int i = 0; i < 1000; ++i) {
        const PlaneMatrix m = any_matrix(draw);
        const Symmetric2 s = any_symmetric(draw), c = congruent(m, s);
        const Plane2 v{draw.in(-1, 1), draw.in(-1, 1)}, w{draw.in(-1, 1), draw.in(-1, 1)};
        const Plane2 v_back = m.transposed()(v), w_back = m.transposed()(w);
        CHECK(std::abs(inner(v, c(w)) - inner(v_back, s(w_back))) <= 64 * epsilon * 32);
        // det (M S M') = det(M)² det S
        const double d = m.determinant();
        CHECK(std::abs(c.determinant() - d * d * s.determinant()) <= 64 * epsilon * 1024);
    }
}

TEST_CASE("plane: principal axes by hand") {
    const Principal2 p({2, 1, 2}); // 3 along the diagonal, 1 across
    CHECK(p.larger == doctest::Approx(3).epsilon(4 * epsilon));
    CHECK(p.smaller == doctest::Approx(1).epsilon(4 * epsilon));
    CHECK(std::abs(std::abs(p.axis.x) - std::sqrt(0.5)) <= 4 * epsilon);
    CHECK(p.axis.x * p.axis.y == doctest::Approx(0.5).epsilon(8 * epsilon));
    const Principal2 upright({1, 0, 9});
    CHECK(upright.larger == 9);
    CHECK(upright.smaller == 1);
    CHECK(std::abs(std::abs(upright.axis.y) - 1) <= epsilon);
}

TEST_CASE("plane: principal axes are eigenvectors and make up the tensor again") {
    Draws draw(6);
    for (int i = 0; i < 1000; ++i) {
        const Symmetric2 m = any_symmetric(draw);
        const Principal2 p(m);
        const double tolerance = 32 * epsilon * 4; // eigenvalues below 4
        CHECK(p.larger >= p.smaller);
        CHECK(std::abs(inner(p.axis, p.axis) - 1) <= 4 * epsilon);
        check_same(m(p.axis), p.larger * p.axis, tolerance);
        const Plane2 across{-p.axis.y, p.axis.x};
        check_same(m(across), p.smaller * across, tolerance);
        check_same(p.with(p.larger, p.smaller), m, tolerance);
        CHECK(std::abs(p.larger + p.smaller - m.trace()) <= tolerance);
    }
}

TEST_CASE("plane: an isotropic tensor and nothing at all have some unit axis") {
    for (const double value : {0.0, 1.0, -3.0}) {
        const Principal2 p(Symmetric2::isotropic(value));
        CHECK(p.larger == value);
        CHECK(p.smaller == value);
        CHECK(std::abs(inner(p.axis, p.axis) - 1) <= 4 * epsilon);
        check_same(p.with(2, 2), Symmetric2::isotropic(2), 8 * epsilon);
    }
}

} // namespace nephroid::tests::plane_test
