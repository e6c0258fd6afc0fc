// SPDX-License-Identifier: MIT
#include "nephroid/smoothing/held_out_picture.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace nephroid::tests::held_out_picture_test {

using detail::HeldOutPicture;
using detail::QuarterPictures;
using detail::squared_bias;

namespace {
constexpr std::size_t vertices = 250'000;

/// Quarters of a bias and noise.
///
/// @param together  noise that the quarters share with alternating signs, so that the mean is free of it
[[nodiscard]] QuarterPictures noisy(double bias, double noise, std::mt19937& random, double together = 0) {
    std::normal_distribution<double> normal;
    QuarterPictures pictures;
    for (auto& quarter : pictures)
        quarter.resize(vertices);
    for (std::size_t i = 0; i < vertices; ++i) {
        const double shared = together * normal(random);
        for (std::size_t k = 0; k < 4; ++k)
            pictures[k][i] = double(i) / vertices + bias + noise * normal(random) + (k % 2 == 0 ? shared : -shared);
    }
    return pictures;
}
} // namespace

// Each product of two differences has a variance of at most 1 here: the mean over the vertices is off by 1/500, 4 σ.
TEST_CASE("held out picture: the bias of a picture is told without its noise") {
    std::mt19937 random(7);
    for (const double bias : {0.0, 0.1, 0.3}) {
        const QuarterPictures sharp = noisy(0, 0.6, random), biased = noisy(bias, 0.4, random);
        CHECK(std::abs(squared_bias(biased, sharp) / vertices - bias * bias) < 8e-3);
    }
}

// The quarters vary by 0.4² each, and half of that is gone from their mean.
TEST_CASE("held out picture: how far stratified quarters fill each other's gaps is told by independent photons") {
    std::mt19937 random(8);
    const double noise = 0.4, half = noise * std::sqrt(0.5);
    const QuarterPictures sharp_quarters = noisy(0, 0.6, random), held_out = noisy(0.1, noise, random);
    const HeldOutPicture pictures(sharp_quarters);
    const auto independent = pictures.stratification(noisy(0.1, noise, random), held_out),
               stratified = pictures.stratification(noisy(0.1, half, random, half), held_out);
    REQUIRE(independent.has_value());
    REQUIRE(stratified.has_value());
    CHECK(std::abs(*independent - 1) < 0.2); // a variance of 0.04 known to 8e-3
    CHECK(*stratified < 0.7);
    CHECK(*stratified > 0.2);
}

// A difference of two errors is 2 (q − p)·sharp but for constants; its noise is that of `sharp`, 0.3 at each vertex.
TEST_CASE("held out picture: the doubt about which picture is better is that of the sharp one") {
    std::mt19937 random(9);
    const HeldOutPicture sharp(noisy(0, 0.6, random));
    std::vector<double> p(vertices, 0.0), q(vertices, 0.5);
    const double expected = 2 * 0.5 * 0.3 * std::sqrt(double(vertices));
    const double found = sharp.standard_error(p, q); // of three degrees of freedom
    CHECK(found > 0.2 * expected);
    CHECK(found < 2.5 * expected);
}

} // namespace nephroid::tests::held_out_picture_test
