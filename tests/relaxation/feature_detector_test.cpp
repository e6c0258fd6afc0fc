// SPDX-License-Identifier: MIT
#include "nephroid/relaxation/feature_detector.hpp"

#include "relaxation/cloud.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace nephroid::tests::feature_detector_test {

namespace {

/// Photons of the unit square, at x < 0.5 `ratio` times as dense as beyond.
[[nodiscard]] std::vector<Stored> weak_edge(int count, double ratio, std::uint32_t seed) {
    Draws draw(seed);
    std::vector<Stored> photons;
    while (int(photons.size()) < count) {
        const double x = draw.in(0, 1), y = draw.in(0, 1);
        if (draw.in(0, ratio) < (x < 0.5 ? ratio : 1))
            photons.push_back(floor_photon(x, y, int(photons.size())));
    }
    return photons;
}

/// How many photons lie within 0.02 of the edge on its dense side less those on the other, over both.
[[nodiscard]] double step_at_edge(const std::vector<Stored>& photons) {
    double dense = 0, thin = 0;
    for (const Stored& photon : photons)
        if (photon.position.y > 0.1 && photon.position.y < 0.9) {
            dense += photon.position.x > 0.48 && photon.position.x <= 0.5;
            thin += photon.position.x > 0.5 && photon.position.x < 0.52;
        }
    return (dense - thin) / (dense + thin);
}

[[nodiscard]] double step_after(double ratio, const RelaxationOptions& options) {
    auto photons = weak_edge(12000, ratio, 140);
    relax(photons, access_to<Stored>(), options, SerialExecutor{});
    return step_at_edge(photons);
}

/// The same of a sharp edge that a Gaussian has blurred: the mean of erf(x/(σ √2)) for x up to 0.02 times the sharp
/// one.
[[nodiscard]] double step_in_theory(double ratio, double spacings) {
    const double deviation = spacings / std::sqrt(12000.0);
    double sum = 0;
    for (int i = 0; i < 100; ++i)
        sum += std::erf(0.02 * (i + 0.5) / 100 / deviation / std::numbers::sqrt2) / 100;
    return (ratio - 1) / (ratio + 1) * sum;
}

} // namespace

// Some N = 12,000 · 0.8 · 0.04 = 380 photons lie in both strips, so that at random a step s varies by
// sqrt((1 − s²)/N) = 0.05; relaxed ones vary by less.
TEST_CASE("features: an edge of a density ratio below three is blurred unless more photons look for weaker ones") {
    constexpr double deviation = 0.05;
    const RelaxationOptions paper, weaker{.feature_neighbours = 400, .alpha = 0.6, .beta = 0.75};
    CHECK(std::abs(step_at_edge(weak_edge(12000, 2, 140)) - 1.0 / 3) < 3 * deviation);
    // Not held, density diffuses by 5.4 spacings in 20 iterations.
    const double blurred = step_after(2, paper);
    CHECK(std::abs(blurred - step_in_theory(2, 5.4)) < 2 * deviation);
    CHECK(blurred < 1.0 / 3 - 3 * deviation);
    CHECK(step_after(2, weaker) > 1.0 / 3 - 2 * deviation);
    CHECK(step_after(5, paper) > 2.0 / 3 - 2 * deviation);
}

} // namespace nephroid::tests::feature_detector_test
