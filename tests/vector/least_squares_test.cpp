// SPDX-License-Identifier: MIT
#include "nephroid/vector/least_squares.hpp"

#include "nephroid/smoothing/second_order/path_derivatives.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace nephroid::tests::least_squares_test {

using namespace nephroid::detail;

TEST_CASE("least squares: exact rows give the unknowns whatever their weights") {
    LeastSquares<3, double> equations;
    const std::array<double, 3> truth{2, -3, 0.5};
    for (int i = 0; i < 7; ++i) {
        const double x = 0.3 * i - 1;
        equations.add({1, x, x * x}, truth[0] + truth[1] * x + truth[2] * x * x, 1 + i);
    }
    std::array<double, 3> x;
    REQUIRE(equations.solve(3, x));
    for (std::size_t i = 0; i < 3; ++i) // a condition of some hundred, squared
        CHECK(std::abs(x[i] - truth[i]) < 1e-11);
}

// The line through (−1, 1), (0, 0), (1, 1) with the weights 1, 2, 1: the mean, 1/2, and no slope.
TEST_CASE("least squares: contradicting rows meet in their weighted mean") {
    LeastSquares<2, double> equations;
    equations.add({1, -1}, 1, 1);
    equations.add({1, 0}, 0, 2);
    equations.add({1, 1}, 1, 1);
    std::array<double, 2> x;
    REQUIRE(equations.solve(2, x));
    CHECK(x[0] == doctest::Approx(0.5).epsilon(1e-14));
    CHECK(std::abs(x[1]) < 1e-15);
}

TEST_CASE("least squares: the unknowns may be vectors and the last of them left out") {
    LeastSquares<3, Double3> equations;
    for (int i = 0; i < 5; ++i)
        equations.add({1, double(i), 0}, {1.0 + 2 * i, 4.0 - i, 0}, 1);
    std::array<Double3, 3> x;
    CHECK(!equations.solve(3, x)); // nothing is known of the third
    REQUIRE(equations.solve(2, x));
    CHECK(x[0].x == doctest::Approx(1).epsilon(1e-12));
    CHECK(x[1].x == doctest::Approx(2).epsilon(1e-12));
    CHECK(x[1].y == doctest::Approx(-1).epsilon(1e-12));
    CHECK(x[2].x == 0);
}

TEST_CASE("least squares: rows that do not span are refused") {
    LeastSquares<2, double> none, parallel;
    std::array<double, 2> x;
    CHECK(!none.solve(2, x));
    parallel.add({1, 2}, 3, 1);
    parallel.add({2, 4}, 6, 1);
    CHECK(!parallel.solve(2, x));
}

} // namespace nephroid::tests::least_squares_test
