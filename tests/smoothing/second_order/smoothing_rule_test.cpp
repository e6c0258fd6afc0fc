// SPDX-License-Identifier: MIT
#include "nephroid/smoothing/second_order/smoothing_rule.hpp"

#include "support/space.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace nephroid::tests::smoothing_rule_test {

using namespace nephroid::detail;
using tests::Draws;

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr SmoothingBounds unbounded{
    .least = 1e-9, .least_radius = 1e-9, .largest_radius = infinity, .stretch = infinity};

void check_close(const Symmetric2& a, const Symmetric2& b, double tolerance) {
    CHECK(std::abs(a.xx - b.xx) <= tolerance);
    CHECK(std::abs(a.xy - b.xy) <= tolerance);
    CHECK(std::abs(a.yy - b.yy) <= tolerance);
}

[[nodiscard]] Symmetric2 log_of(const Symmetric2& q) { return log_bending(q, unbounded); }

/// A positive tensor with a condition below 64.
[[nodiscard]] Symmetric2 any_bending(Draws& draw) {
    const double angle = draw.in(0, 6.3), c = std::cos(angle), s = std::sin(angle);
    return congruent({{c, s}, {-s, c}}, {std::exp(draw.in(-8, -4)), 0, std::exp(draw.in(-8, -4))});
}

} // namespace

// With g = 0.02 (tr Q)² the bias is g s⁴, so that the squared error is g² s⁸ + 2.8/s⁴, or + 1.8/s² for random
// photons: least at s¹² = 1.4/g², s¹⁰ = 0.45/g². Powers of numbers down to 1e-11 cost some ten roundings.
TEST_CASE("smoothing rule: s follows the formula if the map bends equally in all directions") {
    for (const double half_q2 : {1e-5, 1e-4, 1e-3, 1e-2}) {
        const double q2 = 2 * half_q2, g = 0.02 * q2 * q2;
        const Symmetric2 log_q = log_of(Symmetric2::isotropic(half_q2));
        const double halton = std::pow(1.4 / (g * g), 1.0 / 12), random = std::pow(0.45 / (g * g), 1.0 / 10);
        check_close(shape_tensor(log_q, {.stratified = true}, unbounded), Symmetric2::isotropic(halton * halton),
                    64 * epsilon * halton * halton);
        check_close(shape_tensor(log_q, {}, unbounded), Symmetric2::isotropic(random * random),
                    64 * epsilon * random * random);
    }
}

// The rule for two coordinates and random photons has 0.45^(1/10) where this one has 1.2 or 1.5.
TEST_CASE("smoothing rule: area lights have wider footprints of the same shape and bounds") {
    Draws draw(5);
    for (int i = 0; i < 100; ++i) {
        const Symmetric2 log_q = log_of(any_bending(draw)), s = shape_tensor(log_q, {}, unbounded);
        for (const bool stratified : {true, false}) {
            const double wider = (stratified ? 1.2 : 1.5) / std::pow(0.45, 0.1);
            check_close(area_shape_tensor(log_q, stratified, unbounded), wider * wider * s, 1e-12 * s.trace());
        }
        const SmoothingBounds bounds{.least = 5, .least_radius = 6, .largest_radius = 7};
        const Principal2 radii2(area_shape_tensor(log_q, true, bounds));
        CHECK(radii2.larger <= 49 * (1 + 1e-12));
        CHECK(radii2.smaller >= 36 * (1 - 1e-12));
    }
}

TEST_CASE("smoothing rule: the footprint is wide where the map is straight and narrow where it bends") {
    Draws draw(3);
    for (int i = 0; i < 300; ++i) {
        const Symmetric2 q = any_bending(draw), s = shape_tensor(log_of(q), {.stratified = i % 2 == 0}, unbounded);
        const Principal2 axes(q);
        // S Q is a multiple of one: with vectors, S (Q v) = c v.
        const double c = 0.5 * (s.xx * q.xx + 2 * s.xy * q.xy + s.yy * q.yy); // half of tr(S Q)
        for (const Plane2 v : {Plane2{1, 0}, Plane2{0, 1}, axes.axis}) {
            const Plane2 w = s(q(v));
            CHECK(std::abs(w.x - c * v.x) <= 1e-11 * c);
            CHECK(std::abs(w.y - c * v.y) <= 1e-11 * c);
        }
        // det S = s⁴ with g = 0.02 · 4 det Q, and tr(S Q) = 2 s² sqrt(det Q): the least that any S of this
        // determinant has.
        const double g = 0.08 * q.determinant();
        const double r = i % 2 == 0 ? std::pow(1.4 / (g * g), 1.0 / 12) : std::pow(0.45 / (g * g), 0.1);
        CHECK(s.determinant() == doctest::Approx(std::pow(r, 4)).epsilon(1e-10));
        CHECK(2 * c == doctest::Approx(2 * r * r * std::sqrt(q.determinant())).epsilon(1e-10));
        const double stretch = draw.in(1.1, 3);
        const Symmetric2 other = congruent({{stretch, 0}, {draw.in(-1, 1), 1 / stretch}}, s);
        CHECK(other.xx * q.xx + 2 * other.xy * q.xy + other.yy * q.yy > 2 * c);
    }
}

// By brute force: no s within 30% has a smaller error, and steps of 1/1000 find the least to half of that.
TEST_CASE("smoothing rule: the best s has the least squared error for any mixture of noise, bend and kinks") {
    Draws draw(8);
    for (int i = 0; i < 500; ++i) {
        const bool is_mixed = i % 3 == 0;
        const double stratified = is_mixed || i % 3 == 1 ? std::exp(draw.in(-6, 1)) : 0,
                     random = is_mixed || i % 3 == 2 ? std::exp(draw.in(-6, 1)) : 0, g = std::exp(draw.in(-25, -3)),
                     k = i % 7 == 0 ? 0 : std::exp(draw.in(-20, 2));
        const auto error = [&](double s) {
            return stratified / std::pow(s, 4) + random / (s * s) + g * g * std::pow(s, 8) + k * s;
        };
        const double s = best_smoothing(stratified, random, g, k);
        double least = s;
        for (int step = -300; step <= 300; ++step)
            if (const double other = s * (1 + 0.001 * step); error(other) < error(least))
                least = other;
        CAPTURE(stratified);
        CAPTURE(random);
        CAPTURE(g);
        CAPTURE(k);
        CHECK(std::abs(least - s) <= 0.0005 * s);
    }
}

// Without a bend to speak of the error of random photons is 1.8/s² + 0.14 κ s, the least at s³ = 3.6/(0.14 κ); that
// of stratified ones at s⁵ = 11.2/(0.14 κ). Of a share p of random photons each has 1/p of the domain: lengths are
// shorter by sqrt(p) in its unit, and s, by u0, longer.
TEST_CASE("smoothing rule: kinks make footprints smaller, by the formula where nothing else bends") {
    const Symmetric2 straight = log_of(Symmetric2::isotropic(1e-12));
    for (const double kinks : {1e-3, 1e-2, 0.1}) {
        const auto s2 = [&](const PhotonDensity& density) {
            const Symmetric2 s = shape_tensor(straight, density, unbounded, kinks);
            CHECK(std::abs(s.xx - s.yy) + std::abs(s.xy) <= 1e-9 * s.xx);
            return s.xx;
        };
        CHECK(s2({}) == doctest::Approx(std::pow(3.6 / (0.14 * kinks), 2.0 / 3)).epsilon(1e-9));
        CHECK(s2({.stratified = true}) == doctest::Approx(std::pow(11.2 / (0.14 * kinks), 0.4)).epsilon(1e-9));
        CHECK(s2({.share = 0.25}) == doctest::Approx(4 * std::pow(3.6 / (0.14 * kinks * 2), 2.0 / 3)).epsilon(1e-9));
    }
    Draws draw(9);
    for (int i = 0; i < 100; ++i) {
        const Symmetric2 log_q = log_of(any_bending(draw));
        const PhotonDensity density{.stratified = i % 2 == 0, .share = draw.in(0.1, 1)};
        const double more = shape_tensor(log_q, density, unbounded, 0.02).determinant(),
                     few = shape_tensor(log_q, density, unbounded, 0.01).determinant(),
                     none = shape_tensor(log_q, density, unbounded).determinant();
        CHECK(more < few);
        CHECK(few < none);
    }
}

TEST_CASE("smoothing rule: log bending keeps eigenvalues within the stretch") {
    const SmoothingBounds bounds{.stretch = 4};
    const Symmetric2 needle = log_bending({1, 0, 1e-9}, bounds);
    CHECK(needle.xx == doctest::Approx(0));
    CHECK(needle.yy == doctest::Approx(-std::log(16.0)));
    CHECK(needle.xy == doctest::Approx(0));
    Draws draw(6);
    for (int i = 0; i < 100; ++i) { // logarithm and exponential undo each other
        const Symmetric2 q = any_bending(draw);
        const Principal2 p(log_of(q));
        check_close(p.with(std::exp(p.larger), std::exp(p.smaller)), q, 64 * epsilon * q.trace());
    }
}

TEST_CASE("smoothing rule: bounds hold for any bend") {
    const SmoothingBounds bounds{.least = 5, .least_radius = 2, .largest_radius = 32, .stretch = 8};
    Draws draw(7);
    for (int i = 0; i < 1000; ++i) {
        const double angle = draw.in(0, 6.3), c = std::cos(angle), s = std::sin(angle);
        const Symmetric2 q = congruent({{c, s}, {-s, c}}, {std::exp(draw.in(-30, 3)), 0, std::exp(draw.in(-30, 3))});
        const Principal2 shape(shape_tensor(log_bending(q, bounds), {.stratified = i % 2 == 0}, bounds));
        CHECK(shape.smaller >= 2 * 2 * (1 - 1e-9));
        CHECK(shape.larger <= 32 * 32 * (1 + 1e-9));
        CHECK(shape.larger <= 8 * 8 * shape.smaller * (1 + 1e-9));
    }
    // The least s bounds the area, not one radius.
    const Principal2 least(shape_tensor(log_bending({1, 0, 0.25}, bounds), {.stratified = true}, bounds));
    CHECK(least.larger * least.smaller == doctest::Approx(std::pow(5, 4)).epsilon(1e-12));
    CHECK(least.larger == doctest::Approx(2 * 25).epsilon(1e-12));
}

// The ellipse x' S⁻¹ x < 1 reaches sqrt(n' S n) along n, where it touches at S n: the conjugate direction.
TEST_CASE("smoothing rule: a bound along a direction sets the radius there and keeps the conjugate one") {
    Draws draw(8);
    for (int i = 0; i < 200; ++i) {
        const Symmetric2 s = shape_tensor(log_of(any_bending(draw)), {.stratified = true}, unbounded);
        const double angle = draw.in(0, 6.3);
        const Plane2 n{std::cos(angle), std::sin(angle)}, touch = s(n);
        const double reach = std::sqrt(inner(n, touch)), most = draw.in(0.1, 0.9) * reach;
        const Symmetric2 bounded = bounded_along(s, n, most);
        CHECK(std::sqrt(inner(n, bounded(n))) == doctest::Approx(most).epsilon(1e-9));
        CHECK(std::abs(bounded(n).x * touch.y - bounded(n).y * touch.x) <= 1e-9 * inner(touch, touch));
        const Plane2 conjugate{-touch.y, touch.x}; // (S n) · w = 0
        CHECK(std::abs(bounded(conjugate).x - s(conjugate).x) <=
              1e-9 * std::abs(s.trace()) * std::sqrt(inner(touch, touch)));
        CHECK(std::abs(bounded(conjugate).y - s(conjugate).y) <=
              1e-9 * std::abs(s.trace()) * std::sqrt(inner(touch, touch)));
        CHECK(bounded.determinant() ==
              doctest::Approx(s.determinant() * (most / reach) * (most / reach)).epsilon(1e-8));
        check_close(bounded_along(s, n, 1.01 * reach), s, 0);
    }
    check_close(bounded_along({100, 0, 400}, {1, 0}, 3), {9, 0, 400}, 1e-12);
}

} // namespace nephroid::tests::smoothing_rule_test
