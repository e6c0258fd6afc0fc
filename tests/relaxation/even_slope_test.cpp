// SPDX-License-Identifier: MIT
#include "nephroid/relaxation/even_slope.hpp"

#include "relaxation/cloud.hpp"

#include "nephroid/relaxation/detect_features.hpp"

#include <doctest/doctest.h>

namespace nephroid::tests::even_slope_test {

using namespace nephroid::detail;

namespace {
/// The mean of f(x) over the unit disc, by the midpoint rule in the angle whose cosine is x: dA = 2 sin² dangle.
template <class F>
double disc_mean(const F& f) {
    constexpr int steps = 2000;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double angle = std::numbers::pi * (i + 0.5) / steps;
        sum += 2 * std::sin(angle) * std::sin(angle) / steps * f(std::cos(angle));
    }
    return sum;
}
} // namespace

// The midpoint rule of a periodic smooth function is exact to rounding.
TEST_CASE("even slope: the series are the means over the disc") {
    for (const double a : {0.0, 0.3, 2.0, 9.0, 16.0}) {
        const DiscExponential disc = disc_exponential(a);
        const double mean = disc_mean([a](double x) { return std::exp(a * x); });
        CHECK(disc.mean == doctest::Approx(mean).epsilon(1e-11));
        CHECK(disc.slope ==
              doctest::Approx(disc_mean([a](double x) { return x * std::exp(a * x); })).epsilon(1e-11).scale(mean));
    }
}

// For photons spread as exp(a x) exactly it is n times the relative entropy of that density.
TEST_CASE("even slope: the evidence is that of the best exponential") {
    for (const double a : {0.5, 2.0, 6.0}) {
        const double z = disc_mean([a](double x) { return std::exp(a * x); });
        const double mean = disc_mean([a](double x) { return x * std::exp(a * x); }) / z;
        CHECK(slope_evidence(100, mean) == doctest::Approx(100 * (a * mean - std::log(z))).epsilon(1e-9));
        for (const double other : {0.9 * a, 1.1 * a})
            CHECK(100 * (other * mean - std::log(disc_mean([&](double x) { return std::exp(other * x); }))) <
                  slope_evidence(100, mean));
    }
    CHECK(slope_evidence(100, 0) < 1e-9);
    CHECK(std::isfinite(slope_evidence(100, 1)));
}

// exp(6x) over the unit square: 150 of 3000 photons lie within 0.1 where it is densest, over which it changes by 3.5;
// where it is thinnest by far more.
TEST_CASE("even slope: a steep slope holds fewer photons if edges are told from slopes and an edge as many") {
    Draws draw(112);
    std::vector<Stored> slope;
    while (slope.size() < 3000) {
        const double x = draw.in(0, 1), y = draw.in(0, 1);
        if (draw.in(0, 1) < std::exp(6 * (x - 1)))
            slope.push_back(floor_photon(x, y, int(slope.size())));
    }
    const auto held = [](const std::vector<Stored>& photons, double edge_evidence) {
        RelaxationOptions options;
        options.edge_evidence = edge_evidence;
        double count = 0;
        for (const auto& constraint : detect_features(photons, access_to<Stored>(), options))
            count += constraint.weight > 0;
        return count;
    };
    CHECK(held(slope, 6) < 0.5 * held(slope, 0));
    const auto edge = stepped_floor(5000, 113);
    CHECK(held(edge, 6) > 0.85 * held(edge, 0));
}

} // namespace nephroid::tests::even_slope_test
