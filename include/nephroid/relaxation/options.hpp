// SPDX-License-Identifier: MIT
/// @file  The options of photon relaxation, and the report of what it did.
#pragma once

#include "nephroid/vector/error.hpp"
#include "nephroid/vector/text.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace nephroid {

/// How flux is evened out between neighbouring photons, for maps whose photons differ in intensity or colour.
enum class FluxDiffusion {
    none,
    conserving,   ///< pairs of photons exchange flux: the total is kept to rounding
    weighted_mean ///< [Spencer and Jones 2009, eq. 12]: changes the total, by 0.7 to 0.9% in 20 steps over 2,000
                  ///< random photons with fluxes of 0 to 2
};

/// How the position of a feature is chosen among candidates.
enum class FeatureCriterion {
    likelihood,   ///< where two densities explain the photons best [ours: fewer false features, sharper edges]
    gap_variation ///< where the gaps between photons vary least on both sides [Spencer and Jones 2009, eq. 4]
};

/// Options of photon relaxation [Spencer and Jones 2009]. The defaults are the paper's where nothing else is said.
struct RelaxationOptions {
    unsigned iterations = 20;      ///< 20 for photons of a low-discrepancy sequence, 30 or more for random ones
    unsigned neighbours = 6;       ///< K of eq. 1: how many photons push one, 1 to 32
    double over_relaxation = 2.0;  ///< λ_max of eq. 2, at the first iteration; above 0, at most 16
    double final_relaxation = 1.2; ///< λ_min of eq. 2, approached towards the last; above 0, at most 16
    /// The fraction of its force that a photon follows at the last iteration, falling from 1 at the first; in (0, 1].
    /// The paper's is 1. Over-relaxed photons never come to rest; smaller last steps leave them more even after 50
    /// iterations, but less so after 20.
    double final_step = 1;

    /// How many nearest photons give the density that a photon aims at, 16 to 4096. 0 for none, as in the paper: all
    /// photons then aim at the same distance from each other, which evens out a caustic with its noise. `chosen_by_map`
    /// for the best of 76, 150, 300, 600 and 1200, by leave-one-out. See `keeping_density`.
    unsigned pilot_neighbours = 0;
    static constexpr unsigned chosen_by_map = ~0u;

    bool constrain = true;             ///< find features, and let photons move along them only
    unsigned feature_neighbours = 150; ///< K of the feature search, 16 to 4096
    /// α and β of eq. 8: a photon is held fully where the densities of the two sides of a feature have a ratio of at
    /// most α, and not at all from β on; 0 <= α < β <= 1. The paper: α = 0 for soft caustics, 0.1 to 0.2 for sharp
    /// ones. So an edge is held fully where the densities of its sides differ by a factor of 1/α = 5, and not at all
    /// below 1/β = 2.9: 20 iterations of the paper's then make it 14 spacings wide, from 10% to 90%. Weaker edges take
    /// more photons to be found: α = 0.6, β = 0.75 and 400 `feature_neighbours` hold those of a factor of 2.
    double alpha = 0.2, beta = 0.35;
    FeatureCriterion criterion = FeatureCriterion::likelihood;
    /// How much evidence a feature needs: the logarithm of how many times more likely two densities (or fluxes) make a
    /// neighbourhood's photons than one does; >= 0. `gap_variation` asks it of features of flux alone.
    double evidence = 8;
    /// How much more evidence an edge needs than a slope, a density that grows exponentially across the neighbourhood.
    /// 0 does not compare them and takes steep slopes for edges, as the paper does; so does `gap_variation` always.
    /// Relaxation that keeps densities need not hold slopes, and photons that it holds stay noisy.
    double edge_evidence = 0;
    /// Whether features are also searched for in the photons' flux, its intensity and its colour.
    bool flux_features = true;

    /// ρ of eq. 11: moves of this many radii (of the disc of K + 1 neighbours) are halved, longer ones damped more; 0
    /// damps none.
    double rho = 0.3;
    FluxDiffusion flux_diffusion = FluxDiffusion::none; ///< eq. 12 and 13, once per iteration

    /// Photons whose normals have a smaller cosine between them lie on different surfaces, and ignore each other;
    /// [-1, 1].
    double cos_same_surface = 0.5;
    /// A photon stays within this many radii (of its first disc of K + 1 neighbours) of where it was, so that photons
    /// at the border of a map, which nothing holds from outside, do not drift away. Inside a map hardly any photon
    /// would go farther. Above 0, at most 16; ours. Photons with fewer than K + 1 others on their surface do not move.
    double leash = 2;

    /// Ours, for the least error of estimates from 20 neighbours: photons aim at the densities that the map had, and 12
    /// neighbours push each without over-relaxation, whose cells would show at such bandwidths. Estimate with a kernel
    /// that fades smoothly (`BiweightKernel`).
    [[nodiscard]] static RelaxationOptions keeping_density() {
        RelaxationOptions options;
        options.neighbours = 12;
        options.over_relaxation = options.final_relaxation = 1;
        options.pilot_neighbours = chosen_by_map;
        options.edge_evidence = 6;
        return options;
    }
};

/// What `relax` did.
struct RelaxationReport {
    std::size_t photons = 0;
    unsigned iterations = 0;             ///< done; fewer than asked for if the caller's `progress` returned false
    std::size_t feature_searches = 0;    ///< neighbourhoods of `feature_neighbours` that were searched
    std::size_t constrained_photons = 0; ///< photons with a weight above 0
    unsigned pilot_neighbours = 0;       ///< from which the densities kept were estimated; 0 if none were
    /// The photons avoid each other already, as those of a low-discrepancy sequence do on plain ways: there is little
    /// to gain from relaxing them. Known only if the map chose the pilot, as the next.
    bool stratified = false;
    /// The map had too few photons, or none away from its borders, to choose: 150 were taken.
    bool pilot_unjudged = false;
    /// k for an estimate from the relaxed map with a kernel that fades (`NearestPhotons`).
    std::size_t estimate_neighbours = 20;
    std::vector<double> mean_step; ///< per iteration: a photon's move over the radius of its neighbourhood
};

namespace detail {
/// Refuses options outside the ranges given above.
inline void check(const RelaxationOptions& options, const char* who) {
    const auto require = [&](bool fine, const char* name, double value, const char* range) {
        if (!fine)
            invalid_argument(std::string("nephroid::") + who + ": " + name + " " + text_of(value) + " is not " + range);
    };
    const RelaxationOptions& o = options;
    require(o.neighbours >= 1 && o.neighbours <= 32, "neighbours", o.neighbours, "1 to 32");
    // Beyond a few radii the leash stops every move: a larger number is a mistake.
    require(o.over_relaxation > 0 && o.over_relaxation <= 16, "over_relaxation", o.over_relaxation,
            "above 0 and at most 16");
    require(o.final_relaxation > 0 && o.final_relaxation <= 16, "final_relaxation", o.final_relaxation,
            "above 0 and at most 16");
    require(o.final_step > 0 && o.final_step <= 1, "final_step", o.final_step, "above 0 and at most 1");
    require(o.pilot_neighbours == 0 || o.pilot_neighbours == RelaxationOptions::chosen_by_map ||
                (o.pilot_neighbours >= 16 && o.pilot_neighbours <= 4096),
            "pilot_neighbours", o.pilot_neighbours, "0 or 16 to 4096");
    require(o.feature_neighbours >= 16 && o.feature_neighbours <= 4096, "feature_neighbours", o.feature_neighbours,
            "16 to 4096");
    require(o.beta > 0 && o.beta <= 1, "beta", o.beta, "above 0 and at most 1");
    require(o.alpha >= 0 && o.alpha < o.beta, "alpha", o.alpha, "at least 0 and below beta");
    require(o.criterion == FeatureCriterion::likelihood || o.criterion == FeatureCriterion::gap_variation, "criterion",
            double(o.criterion), "a FeatureCriterion");
    require(o.evidence >= 0 && isfinite(o.evidence), "evidence", o.evidence, "0 or positive, and finite");
    require(o.edge_evidence >= 0 && isfinite(o.edge_evidence), "edge_evidence", o.edge_evidence,
            "0 or positive, and finite");
    require(o.rho >= 0 && isfinite(o.rho), "rho", o.rho, "0 or positive, and finite");
    require(o.flux_diffusion == FluxDiffusion::none || o.flux_diffusion == FluxDiffusion::conserving ||
                o.flux_diffusion == FluxDiffusion::weighted_mean,
            "flux_diffusion", double(o.flux_diffusion), "a FluxDiffusion");
    require(o.cos_same_surface >= -1 && o.cos_same_surface <= 1, "cos_same_surface", o.cos_same_surface, "-1 to 1");
    require(o.leash > 0 && o.leash <= 16, "leash", o.leash, "above 0 and at most 16");
}
} // namespace detail

} // namespace nephroid
