// SPDX-License-Identifier: MIT
/// @file  Traces the photon of a point of a chart along all of its paths, to where they end.
#pragma once

#include "nephroid/emission/chart/emission_chart.hpp"
#include "nephroid/sheet/node_end.hpp"
#include "nephroid/transport/walk.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

namespace nephroid::detail {

/// Stands in for random numbers: gives a scene a constant, and notes that it asked, because then the point of emission
/// does not determine the photon's path.
struct NoChance {
    bool is_asked = false;

    template <class T>
    [[nodiscard]] T next() {
        is_asked = true;
        return T(0.5);
    }
};

/// A visitor that is told every end of a photon's paths.
template <Vector3 V, Flux F, class Land>
struct EndsOfAllWays {
    using trail = PathSignature;
    static constexpr bool follows_all_ways = true;

    const Land& land; ///< land(deposit, signature)

    void deposit(const Deposit<V, F, 0>& deposit, const WalkedPath<PathSignature>& path) const {
        land(deposit, path.trail.value());
    }
};

/// What is counted while nodes are traced.
struct TracedNodes {
    Statistics account;          ///< of the nodes' shares of the light
    double landed = 0;           ///< flux of those shares that ended on a receiver
    std::uint64_t by_chance = 0; ///< nodes whose scene drew a random number

    /// Books a photon whose flux is a density, times the area of the chart that it stands for.
    void add(const Statistics& one, double landed_density, double area) {
        account.rays += one.rays;
        account.specular_events += one.specular_events;
        account.corrected_normals += one.corrected_normals;
        if (!(area > 0))
            return;
        account.branches += one.branches;
        account.hits_at_start += one.hits_at_start;
        account.opaque_first += one.opaque_first;
        account.escaped_first += one.escaped_first;
        account.emitted.photons += one.emitted.photons;
        account.emitted.add(area * one.emitted.flux);
        for (std::size_t i = 0; i < fate_count; ++i) {
            account.fates[i].photons += one.fates[i].photons;
            account.fates[i].add(area * one.fates[i].flux);
        }
        landed += area * landed_density;
    }
};

/// Appends the ends of the paths of a node.
///
/// @param area    of the chart that the node stands for in the account; 0 for one that only refines
/// @param origin  of the receiver
template <class S, Vector3 V, Flux F>
void trace_node(const S& scene, const EmissionChart<V, F>& chart, scalar_t<V> u, scalar_t<V> v, double area,
                const V& origin, const WalkLimits& limits, std::vector<NodeEnd<V, F>>& ends, TracedNodes& traced) {
    // A target is often as wide as its chart: a photon from the very border would miss it by rounding.
    const scalar_t<V> margin = scalar_t<V>(32) * std::numeric_limits<scalar_t<V>>::epsilon();
    const auto inside = [margin](scalar_t<V> x) { return std::clamp(x, margin, scalar_t<V>(1) - margin); };
    const auto emitted = chart.emit(inside(u), inside(v));
    if (!emitted)
        return;
    NoChance sampler;
    Statistics one;
    double landed = 0;
    const auto land = [&](const Deposit<V, F, 0>& deposit, std::uint32_t signature) {
        landed += flux_traits<F>::power(deposit.flux);
        ends.push_back({deposit.position - origin, deposit.normal, deposit.direction, deposit.flux, signature});
    };
    Photon<V, F, 0> photon{emitted->position, emitted->direction, emitted->flux, {}};
    if constexpr (ScattersDeterministically<S, V>) {
        walk(scene, std::move(photon), sampler, limits, one, EndsOfAllWays<V, F, decltype(land)>{land});
    } else {
        WalkLimits without_roulette = limits;
        without_roulette.roulette_after = (std::numeric_limits<unsigned>::max)();
        PathSignature signature;
        if (const auto deposit = walk(scene, std::move(photon), sampler, without_roulette, one, signature))
            land(*deposit, signature.value());
    }
    traced.add(one, landed, area);
    traced.by_chance += std::uint64_t(sampler.is_asked);
}

} // namespace nephroid::detail
