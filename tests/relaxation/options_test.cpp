// SPDX-License-Identifier: MIT
#include "nephroid/relaxation/options.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <stdexcept>

namespace nephroid::tests::options_test {

namespace {

std::string complaint(const RelaxationOptions& options) {
    try {
        detail::check(options, "relax");
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
}

} // namespace

TEST_CASE("relaxation options: the defaults and the bounds are fine") {
    CHECK(complaint({}).empty());
    CHECK(complaint({.iterations = 0, .neighbours = 1, .feature_neighbours = 16, .alpha = 0, .beta = 1}).empty());
    CHECK(complaint(RelaxationOptions::keeping_density()).empty());
    CHECK(complaint({.pilot_neighbours = 16}).empty());
    CHECK(complaint({.neighbours = 32, .feature_neighbours = 4096, .rho = 0, .cos_same_surface = -1}).empty());
}

TEST_CASE("relaxation options: what cannot be is named with its value") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(complaint({.neighbours = 0}) == "nephroid::relax: neighbours 0 is not 1 to 32");
    CHECK(complaint({.neighbours = 33}) == "nephroid::relax: neighbours 33 is not 1 to 32");
    CHECK(complaint({.over_relaxation = 0}) == "nephroid::relax: over_relaxation 0 is not above 0 and at most 16");
    CHECK(complaint({.final_relaxation = nan}) ==
          "nephroid::relax: final_relaxation nan is not above 0 and at most 16");
    CHECK(complaint({.final_step = 1.5}) == "nephroid::relax: final_step 1.5 is not above 0 and at most 1");
    CHECK(complaint({.pilot_neighbours = 15}) == "nephroid::relax: pilot_neighbours 15 is not 0 or 16 to 4096");
    CHECK(complaint({.pilot_neighbours = 4097}) == "nephroid::relax: pilot_neighbours 4097 is not 0 or 16 to 4096");
    CHECK(complaint({.feature_neighbours = 15}) == "nephroid::relax: feature_neighbours 15 is not 16 to 4096");
    CHECK(complaint({.alpha = -0.5}) == "nephroid::relax: alpha -0.5 is not at least 0 and below beta");
    CHECK(complaint({.alpha = 0.5, .beta = 0.5}) == "nephroid::relax: alpha 0.5 is not at least 0 and below beta");
    CHECK(complaint({.over_relaxation = 1e30}) ==
          "nephroid::relax: over_relaxation 1e+30 is not above 0 and at most 16");
    CHECK(complaint({.final_relaxation = 17}) == "nephroid::relax: final_relaxation 17 is not above 0 and at most 16");
    CHECK(complaint({.beta = 1.25}) == "nephroid::relax: beta 1.25 is not above 0 and at most 1");
    CHECK(complaint({.beta = -1}) == "nephroid::relax: beta -1 is not above 0 and at most 1");
    CHECK(complaint({.beta = nan}) == "nephroid::relax: beta nan is not above 0 and at most 1");
    CHECK(complaint({.alpha = nan}) == "nephroid::relax: alpha nan is not at least 0 and below beta");
    CHECK(complaint({.criterion = FeatureCriterion(5)}) == "nephroid::relax: criterion 5 is not a FeatureCriterion");
    CHECK(complaint({.flux_diffusion = FluxDiffusion(7)}) ==
          "nephroid::relax: flux_diffusion 7 is not a FluxDiffusion");
    CHECK(complaint({.evidence = -1}) == "nephroid::relax: evidence -1 is not 0 or positive, and finite");
    CHECK(complaint({.rho = -1}) == "nephroid::relax: rho -1 is not 0 or positive, and finite");
    CHECK(complaint({.cos_same_surface = 2}) == "nephroid::relax: cos_same_surface 2 is not -1 to 1");
    CHECK(complaint({.leash = 0}) == "nephroid::relax: leash 0 is not above 0 and at most 16");
    CHECK(complaint({.leash = 1e30}) == "nephroid::relax: leash 1e+30 is not above 0 and at most 16");
    CHECK(complaint({.edge_evidence = -1}) == "nephroid::relax: edge_evidence -1 is not 0 or positive, and finite");
}

} // namespace nephroid::tests::options_test
