// SPDX-License-Identifier: MIT
#include "nephroid/quality/reference/ball.hpp"
#include "nephroid/quality/reference/ring.hpp"
#include "nephroid/quality/reference/wave.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace nephroid::reference::film_test {

namespace {

template <class F>
std::string message_of(const F& f) {
    try {
        f();
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
}

bool starts_with(const std::string& text, const std::string& start) {
    return text.compare(0, start.size(), start) == 0;
}

} // namespace

TEST_CASE("reference: an impossible film is refused with the function's and the value's name") {
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    CHECK(starts_with(message_of([] {
                          (void)wave({}, {0, 1, 0, 1, 0, 4});
                      }),
                      "nephroid::reference::wave: film.width is 0, "));
    CHECK(starts_with(message_of([] {
                          (void)ring({}, {0, 1, 0, 1, 4, -3});
                      }),
                      "nephroid::reference::ring: film.height is -3, "));
    CHECK(starts_with(message_of([] {
                          (void)ball({}, {1, 1, 0, 1, 4, 4});
                      }),
                      "nephroid::reference::ball: film.x_max is 1, "));
    CHECK(starts_with(message_of([] {
                          (void)ball({}, {0, 1, 3, 1, 4, 4});
                      }),
                      "nephroid::reference::ball: film.y_max is 1, "));
    CHECK(starts_with(message_of([=] {
                          (void)wave({}, {nan, 1, 0, 1, 4, 4});
                      }),
                      "nephroid::reference::wave: film.x_min is nan"));
    CHECK(starts_with(message_of([=] {
                          (void)wave({}, {0, inf, 0, 1, 4, 4});
                      }),
                      "nephroid::reference::wave: film.x_max is inf"));
    CHECK(starts_with(message_of([=] {
                          (void)ring({}, {0, 1, -inf, 1, 4, 4});
                      }),
                      "nephroid::reference::ring: film.y_min is -inf"));
    CHECK(starts_with(message_of([] {
                          (void)wave({}, {0, 1, 0, 1, 65537, 4});
                      }),
                      "nephroid::reference::wave: film.width is 65537"));
}

TEST_CASE("reference: a scene out of range is refused with the value's name") {
    CHECK(starts_with(message_of([] { (void)wave({.amplitude = -0.01}, {}); }),
                      "nephroid::reference::wave: amplitude is -0.01"));
    CHECK(starts_with(message_of([] { (void)wave_mean({.amplitude = 0.2}); }),
                      "nephroid::reference::wave: amplitude is 0.2"));
    CHECK(starts_with(message_of([] { (void)ring({static_cast<Reflections>(7)}, {}); }),
                      "nephroid::reference::ring: reflections is 7"));
    CHECK(starts_with(message_of([] { (void)ball({static_cast<BallLight>(7)}, {}); }),
                      "nephroid::reference::ball: source is 7"));
    CHECK(starts_with(message_of([] { (void)ball_flux({}, -1); }), "nephroid::reference::ball_flux: radius is -1"));
}

TEST_CASE("reference: the mean of an image is that of its pixels, and 0 without any") {
    CHECK(mean({1, 2, 6}) == 3);
    CHECK(mean({}) == 0);
}

TEST_CASE("reference: Gauss-Legendre quadrature with N nodes is exact up to degree 2N - 1 and no further") {
    const auto power = [](int n) { return [n](double x) { return std::pow(x, n); }; };
    CHECK(std::abs(detail::integrate<4>(power(7), 1, 2) - 255.0 / 8) < 1e-13); // a few roundings of 32
    CHECK(std::abs(detail::integrate<4>(power(8), 1, 2) - 511.0 / 9) > 1e-7);
    CHECK(std::abs(detail::integrate<10>(power(19), 0, 1) - 1.0 / 20) < 1e-15);
    CHECK(std::abs(detail::integrate<16>(power(31), 0, 1) - 1.0 / 32) < 1e-15);
    CHECK(std::abs(detail::integrate_panels<4>([](double x) { return std::exp(x); }, 3, 0, 0.1) - (1 - std::exp(3.0))) <
          1e-12);
}

TEST_CASE("reference: a Chebyshev polynomial reproduces an exponential") {
    const detail::Chebyshev exponential([](double x) { return std::exp(x); }, -1, 2, 20);
    for (int i = 0; i <= 30; ++i) // the series ends with terms of 1.5^20 / 20! = 1e-15
        CHECK(std::abs(exponential(-1 + 0.1 * i) - std::exp(-1 + 0.1 * i)) < 2e-14);
}

TEST_CASE("reference: all roots are found, also those that nearly touch") {
    std::vector<double> roots;
    detail::find_roots([](double x) { return std::cos(x) - (1 - 1e-12); }, -1, 7, 1, roots); // 1.4e-6 beside 0 and 2 pi
    REQUIRE(roots.size() == 4);
    CHECK(std::is_sorted(roots.begin(), roots.end()));
    CHECK(std::abs(roots[1] - std::sqrt(2e-12)) < 1e-9); // cos varies by 1e-16 / 1.4e-6 per unit there
    CHECK(std::abs(roots[3] - 2 * std::numbers::pi - std::sqrt(2e-12)) < 1e-9);
    roots.clear();
    detail::find_roots([](double x) { return std::cos(x) + 1.001; }, -10, 10, 1, roots);
    CHECK(roots.empty());
    CHECK(std::abs(detail::root_between([](double x) { return x * x * x - 2; }, 0, 4) - std::cbrt(2.0)) < 1e-15);
}

// Reflectances: normal incidence gives ((n - 1)/(n + 1))^2; at Brewster's angle, tan = n, only s is reflected.
TEST_CASE("reference: the transmittance is right at normal incidence, at Brewster's angle, grazing, and backwards") {
    const double n = 1.5, brewster = n / std::sqrt(1 + n * n), s = (1 - n * n) / (1 + n * n);
    CHECK(std::abs(detail::transmittance(0, n) - 0.96) < 1e-15);
    CHECK(std::abs(detail::transmittance(brewster, n) - (1 - 0.5 * s * s)) < 1e-15);
    CHECK(std::abs(detail::transmittance(1, n)) < 1e-15);
    CHECK(std::abs(detail::transmittance(0.7, n) - detail::transmittance(0.7 / n, 1 / n)) < 1e-15);
}

} // namespace nephroid::reference::film_test
