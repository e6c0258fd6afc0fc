// SPDX-License-Identifier: MIT
#include "nephroid/sheet/pixel_coverage.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

namespace nephroid::tests::coverage_test {

using nephroid::detail::covered_share;
using nephroid::detail::edge_integral;
using nephroid::detail::FootprintPlace;

namespace {

template <class R>
using Triangle = std::array<FootprintPlace<R>, 3>;

template <class R>
[[nodiscard]] R area_within(const Triangle<R>& c, R square_s, R square_t) {
    R sum(0);
    for (std::size_t i = 0; i < 3; ++i) {
        const auto &a = c[i], &b = c[(i + 1) % 3];
        sum += edge_integral<R>(a.s - square_s, a.t - square_t, b.s - square_s, b.t - square_t);
    }
    return sum;
}

template <class R>
[[nodiscard]] R signed_area(const Triangle<R>& c) {
    return R(0.5) * nephroid::detail::doubled_area(c);
}

template <class R>
[[nodiscard]] Triangle<R> random_triangle(std::mt19937& random, R low, R high) {
    std::uniform_real_distribution<R> place(low, high);
    Triangle<R> c;
    for (auto& corner : c)
        corner = {place(random), place(random)};
    return c;
}

} // namespace

TEST_CASE_TEMPLATE("coverage: over squares side by side a triangle's parts add up to its area", R, float, double) {
    std::mt19937 random(1);
    for (int trial = 0; trial < 200; ++trial) {
        const Triangle<R> c = random_triangle<R>(random, R(0.1), R(4.9));
        R sum(0);
        for (int i = 0; i < 5; ++i)
            for (int j = 0; j < 5; ++j)
                sum += area_within(c, R(i), R(j));
        // Seventy-five edges of up to five squares' size, each rounded a few times.
        CHECK(std::abs(sum - signed_area(c)) <= R(200) * std::numeric_limits<R>::epsilon());
    }
}

TEST_CASE("coverage: as much of a triangle lies in the square as of 4,096 points of the square in the triangle") {
    std::mt19937 random(2);
    for (int trial = 0; trial < 100; ++trial) {
        const Triangle<double> c = random_triangle<double>(random, -0.7, 1.7);
        const double sign = signed_area(c) < 0 ? -1 : 1;
        int inside = 0;
        for (int k = 0; k < 4096; ++k) {
            const FootprintPlace<double> p{(k % 64 + 0.5) / 64, (k / 64 + 0.5) / 64};
            bool is_inside = true;
            for (std::size_t i = 0; i < 3; ++i)
                is_inside &= sign * signed_area<double>({c[i], c[(i + 1) % 3], p}) >= 0;
            inside += is_inside;
        }
        // Only sub-squares that the border crosses can count wrongly: three sides cross at most 128 each, and half of
        // what they cross cancels or better; a hundredth of the square is far above that.
        CHECK(std::abs(sign * area_within(c, 0.0, 0.0) - inside / 4096.0) <= 0.01);
    }
}

TEST_CASE("coverage: an edge beside, above and across the square adds what the integral says") {
    CHECK(edge_integral(2.0, 0.0, 2.0, 1.0) == 1.0);                   // right of it: the whole width
    CHECK(edge_integral(-1.0, 0.0, -1.0, 1.0) == 0.0);                 // left of it
    CHECK(edge_integral(0.25, 0.0, 0.25, 1.0) == 0.25);                // upright within
    CHECK(edge_integral(0.0, 0.0, 1.0, 1.0) == 0.5);                   // the diagonal
    CHECK(edge_integral(1.0, 1.0, 0.0, 0.0) == -0.5);                  // and back
    CHECK(edge_integral(0.0, 2.0, 1.0, 3.0) == 0.0);                   // above it
    CHECK(edge_integral(0.5, 0.5, 0.9, 0.5) == 0.0);                   // level
    CHECK(edge_integral(-1.0, 0.0, 2.0, 1.0) == doctest::Approx(0.5)); // from left of it to right of it
}

TEST_CASE("coverage: float is as good as double down to slivers of a ten thousandth of a pixel") {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(-1, 2), width(-1, 1);
    for (int trial = 0; trial < 1000; ++trial) {
        const FootprintPlace<double> a{place(random), place(random)}, b{place(random), place(random)};
        const double length = std::hypot(b.s - a.s, b.t - a.t);
        const double height = 2e-4 / length; // so that the area is 10⁻⁴
        const double along = 0.5 * (1 + width(random));
        const FootprintPlace<double> c{a.s + along * (b.s - a.s) - height * (b.t - a.t) / length,
                                       a.t + along * (b.t - a.t) + height * (b.s - a.s) / length};
        Triangle<float> rounded;
        Triangle<double> exact;
        for (std::size_t i = 0; const auto& p : {a, b, c}) {
            rounded[i] = {float(p.s), float(p.t)};
            exact[i] = {double(rounded[i].s), double(rounded[i].t)};
            ++i;
        }
        // Three integrals of up to 1, each rounded a few times.
        CHECK(double(area_within(rounded, 0.0f, 0.0f)) ==
              doctest::Approx(area_within(exact, 0.0, 0.0)).epsilon(0).scale(1).epsilon(2e-6));
    }
}

TEST_CASE("coverage: a triangle without area is shared out along its longest side") {
    const Triangle<double> line{{{-0.5, 0.3}, {1.5, 0.3}, {0.1, 0.3}}};
    CHECK(covered_share(line) == doctest::Approx(0.5));
    const auto moved = [](Triangle<double> c, double s, double t) {
        for (auto& p : c)
            p.s -= s, p.t -= t;
        return c;
    };
    double sum = 0;
    for (int i = -2; i < 4; ++i)
        for (int j = -2; j < 4; ++j)
            sum += covered_share(moved(line, i, j));
    CHECK(sum == doctest::Approx(1));
    const Triangle<double> on_border{{{0.2, 1.0}, {0.8, 1.0}, {0.5, 1.0}}}; // of two squares: lies in one
    CHECK(covered_share(on_border) + covered_share(moved(on_border, 0, 1)) == 1);
    const Triangle<double> point{{{0.5, 0.5}, {0.5, 0.5}, {0.5, 0.5}}};
    CHECK(covered_share(point) == 1);
    CHECK(covered_share(moved(point, 1, 0)) == 0);
}

} // namespace nephroid::tests::coverage_test
