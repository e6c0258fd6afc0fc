// SPDX-License-Identifier: MIT
#include "nephroid/vector/dual.hpp"

#include "support/space.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace nephroid::tests::dual_test {

using tests::Wide;

namespace {

/// f'(x) by differences in wide precision, right to 1e-12 where f is analytic within 0.5 of x.
template <class F>
[[nodiscard]] double slope_of(const F& f, double x) {
    return static_cast<double>(tests::derivative([&](const Wide& h) { return f(Wide(x) + h); }));
}

/// Checks f's derivative at x against differences, in the first and in the second of two parameters.
template <class F>
void check(const F& f, double x) {
    const double expected = slope_of(f, x), tolerance = 1e-11 * (1 + std::abs(expected));
    CHECK(std::abs(f(Dual<double>::parameter(x)).derivative() - expected) <= tolerance);
    const auto second = f(Dual<double, 2>::parameter(x, 1));
    CHECK(second.derivative(0) == 0);
    CHECK(std::abs(second.derivative(1) - expected) <= tolerance);
    CHECK(f(Dual<float>::parameter(float(x))).derivative() == doctest::Approx(expected).epsilon(1e-5));
}

} // namespace

static_assert(Scalar<Dual<float>> && Scalar<Dual<double, 3>> && Scalar<Dual<Dual<double, 2>, 2>>);
static_assert(std::numeric_limits<Dual<float>>::digits == 24);

TEST_CASE("dual: arithmetic and roots have the derivatives that differences have") {
    for (const double x : {0.7, 1.0, 2.3}) {
        check([](const auto& a) { return a * a * a - 2 * a + 1; }, x);
        check([](const auto& a) { return (3 - a) / (a * a + 1); }, x);
        check([](const auto& a) { return sqrt(a * a + 1) / a; }, x);
        check([](const auto& a) { return -abs(-a) * abs(a); }, x);
        check(
            [](auto a) {
                auto b = a;
                b = b * a;
                return b + (a - 1);
            },
            x);
    }
}

// sin' = cos, cos' = −sin, exp' = exp, and atan2 of (sin t, cos t) is t.
TEST_CASE("dual: sines and exponentials have the derivatives that are known") {
    constexpr double epsilon = std::numeric_limits<double>::epsilon();
    for (const double x : {-1.2, 0.0, 0.4, 3.0}) {
        const auto a = Dual<double>::parameter(x);
        CHECK(std::abs(sin(a).derivative() - std::cos(x)) <= epsilon);
        CHECK(std::abs(cos(a).derivative() + std::sin(x)) <= epsilon);
        CHECK(std::abs(exp(2 * a).derivative() - 2 * std::exp(2 * x)) <= 4 * epsilon * std::exp(2 * x));
        CHECK(std::abs(atan2(sin(a), cos(a)).derivative() - 1) <= 4 * epsilon);
    }
    // To x, y: (−y, x) / r².
    const auto y = Dual<double, 2>::parameter(-1.3, 0), x = Dual<double, 2>::parameter(0.7, 1);
    CHECK(std::abs(atan2(y, x).derivative(0) - 0.7 / (1.3 * 1.3 + 0.7 * 0.7)) <= epsilon);
    CHECK(std::abs(atan2(y, x).derivative(1) - 1.3 / (1.3 * 1.3 + 0.7 * 0.7)) <= epsilon);
}

TEST_CASE("dual: what is added up in place is what the operators give") {
    const auto x = Dual<double, 2>::parameter(3, 0), y = Dual<double, 2>::parameter(5, 1);
    auto sum = x;
    sum += y;
    sum *= x;
    sum -= y;
    sum /= x; // ((x + y) x − y) / x = x + y − y/x
    CHECK(sum.value() == doctest::Approx(8 - 5.0 / 3));
    CHECK(sum.derivative(0) == doctest::Approx(1 + 5.0 / 9));
    CHECK(sum.derivative(1) == doctest::Approx(1 - 1.0 / 3));
}

TEST_CASE("dual: comparisons and conversions look at the value alone") {
    const Dual<double> a(2, {1}), b(2, {-7});
    CHECK(a == b);
    CHECK(a <= b);
    CHECK(a >= b);
    CHECK(!(a < b));
    CHECK(!(a > b));
    CHECK(a < 3);
    CHECK(double(b) == 2);
    CHECK(int(b) == 2);
}

TEST_CASE("dual: where there is no derivative it is zero and what is no number is told") {
    CHECK(sqrt(Dual<double>::parameter(0)).derivative() == 0);
    CHECK(atan2(Dual<double>(0, {1}), Dual<double>(0, {1})).derivative() == 0);
    CHECK(isfinite(Dual<double>(1, {2})));
    CHECK(!isfinite(Dual<double>(1, {std::numeric_limits<double>::infinity()})));
    CHECK(!isfinite(Dual<double>(std::numeric_limits<double>::quiet_NaN(), {0})));
}

// d²/dx dy of x² y³ is 6 x y².
TEST_CASE("dual: of dual numbers there are second derivatives") {
    using Inner = Dual<double, 2>;
    using Twice = Dual<Inner, 2>;
    const Twice x(Inner::parameter(0.5, 0), {Inner(1), Inner(0)}), y(Inner::parameter(2, 1), {Inner(0), Inner(1)});
    const Twice f = x * x * y * y * y;
    CHECK(f.derivative(0).derivative(1) == doctest::Approx(6 * 0.5 * 4));
    CHECK(f.derivative(1).derivative(0) == doctest::Approx(6 * 0.5 * 4));
    CHECK(f.derivative(0).derivative(0) == doctest::Approx(2 * 8));
    CHECK(sqrt(x).derivative(0).derivative(0) == doctest::Approx(-0.25 / std::pow(0.5, 1.5)));
    CHECK(double(f.derivative(1).value()) == doctest::Approx(3 * 0.25 * 4));
}

} // namespace nephroid::tests::dual_test
