// SPDX-License-Identifier: MIT
#include "nephroid/relaxation/flux_discontinuity.hpp"

#include "support/space.hpp"

#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>

#include <vector>

namespace nephroid::tests::flux_discontinuity_test {

using namespace nephroid::detail;
using tests::Draws;

namespace {

/// 100 evenly spaced photons, of one flux left of 0.2 and of another right of it.
template <class F>
std::optional<Discontinuity> across_step(const F& left, const F& right) {
    std::vector<double> coordinates;
    std::vector<F> fluxes;
    for (int i = 0; i < 100; ++i) {
        coordinates.push_back(-0.99 + 0.02 * i);
        fluxes.push_back(coordinates.back() < 0.2 ? left : right);
    }
    return flux_discontinuity<double, F>(coordinates, fluxes);
}

} // namespace

TEST_CASE("flux discontinuity: lies between the two fluxes and is their ratio") {
    for (const auto& [left, right] : {std::pair{1.0, 4.0}, {4.0, 1.0}, {1.0, 0.0}}) {
        const auto found = across_step(left, right);
        REQUIRE(found.has_value());
        CHECK(found->coordinate == doctest::Approx(0.2).epsilon(1e-9)); // between the photons at 0.19 and 0.21
        CHECK(found->homogeneity == doctest::Approx(std::min(left, right) / std::max(left, right)).epsilon(1e-6));
        CHECK(found->evidence > 100);
    }
}

// |white − red| / |white| = √2/√3; red and green have nothing in common.
TEST_CASE("flux discontinuity: colours of the same power differ too") {
    using Rgb = glm::vec3;
    CHECK(across_step<Rgb>({3, 0, 0}, {0, 3, 0})->homogeneity == 0);
    const auto white_red = across_step<Rgb>({1, 1, 1}, {1, 0, 0});
    CHECK(white_red->homogeneity == doctest::Approx(1 - std::sqrt(2.0 / 3)).epsilon(1e-5));
    CHECK(white_red->coordinate == doctest::Approx(0.2).epsilon(1e-9));
    CHECK(across_step<Rgb>({1, 2, 3}, {1, 2, 2.9f})->homogeneity > 0.97);
}

TEST_CASE("flux discontinuity: there is none among equal fluxes or too few photons") {
    CHECK(across_step(2.5, 2.5) == std::nullopt);
    CHECK(across_step<glm::vec3>({0.1f, 0.2f, 0.3f}, {0.1f, 0.2f, 0.3f}) == std::nullopt);
    CHECK(across_step(0.0, 0.0) == std::nullopt);
    const std::vector<double> coordinates(15, 0.0), fluxes{0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1};
    CHECK(flux_discontinuity<double, double>(coordinates, fluxes) == std::nullopt);
}

// Normal deviates of one mean: the evidence of the best of 84 splits is about the largest of 2 · log(100) halves of
// χ²(1).
TEST_CASE("flux discontinuity: noise of one mean is hardly ever taken for an edge") {
    Draws draw(31);
    int taken = 0;
    for (int trial = 0; trial < 400; ++trial) {
        std::vector<double> coordinates, fluxes;
        for (int i = 0; i < 100; ++i) {
            coordinates.push_back(-0.99 + 0.02 * i);
            double sum = 4; // twelve uniform numbers vary as one normal deviate
            for (int k = 0; k < 12; ++k)
                sum += draw.in(-0.5, 0.5);
            fluxes.push_back(sum);
        }
        const auto found = flux_discontinuity<double, double>(coordinates, fluxes);
        taken += found && found->evidence > 8;
    }
    CHECK(taken <= 4);
}

} // namespace nephroid::tests::flux_discontinuity_test
