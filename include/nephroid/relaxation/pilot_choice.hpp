// SPDX-License-Identifier: MIT
/// @file  Chooses for a map from how many photons to estimate the densities that relaxation aims at, its pilot.
///
/// With too few the pilot's own noise becomes the target, with too many it levels out what relaxation should keep. With
/// each candidate the density at some photons is estimated from their neighbours, without themselves. The best
/// candidate finds the largest densities there, by the mean of their logarithms [leave-one-out likelihood: Habbema,
/// Hermans and van den Broek 1974; Duin 1976].
///
/// Maps of fewer than 600 photons are too small for two candidates. They get the number that serves most maps, as do
/// maps in which fewer than 128 of the photons asked lie away from the borders.
#pragma once

#include "nephroid/relaxation/photon_cloud.hpp"
#include "nephroid/relaxation/surrounded.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace nephroid::detail {

struct PilotChoice {
    unsigned neighbours; ///< of the pilot
    bool stratified;     ///< the photons avoid each other already, as those of a low-discrepancy sequence do
    bool judged;         ///< whether candidates could be compared; else `neighbours` is what serves most maps
};

/// Sums over some photons; those of two sets of photons add up.
struct PilotEvidence {
    static constexpr std::array<unsigned, 5> candidates = {38, 75, 150, 300, 600};
    std::array<double, candidates.size()> log_density{}; ///< but for a constant that all share
    double judged = 0;                                   ///< photons that candidates were compared at
    double nearness = 0;                                 ///< Σ (d₁/d₁₆)²
    double seen = 0;                                     ///< photons in that sum

    void add(const PilotEvidence& other) {
        for (std::size_t i = 0; i < candidates.size(); ++i)
            log_density[i] += other.log_density[i];
        judged += other.judged, nearness += other.nearness, seen += other.seen;
    }

    /// Takes in one photon.
    /// @param distance2  of its neighbours, ascending, without itself
    /// @param usable     how many of the candidates are compared: none, or at least two
    /// @param inside     whether photons lie around it on all sides: at a border each estimate is too low
    template <class T>
    void add(const std::vector<Neighbour<T>>& nearest, std::size_t usable, bool inside) {
        if (nearest.size() >= 16 && nearest[15].distance2 > T(0)) {
            nearness += double(nearest[0].distance2 / nearest[15].distance2);
            ++seen;
        }
        if (!inside || usable == 0 || nearest.size() < candidates[usable - 1])
            return;
        std::array<double, candidates.size()> logs{};
        for (std::size_t i = 0; i < usable; ++i) {
            const double radius2 = double(nearest[candidates[i] - 1].distance2);
            double sum = 0;
            for (std::size_t n = 0; n + 1 < candidates[i]; ++n)
                sum += 1 - double(nearest[n].distance2) / radius2;
            if (!(radius2 > 0) || !(sum > 0))
                return; // as many in one place
            logs[i] = std::log(sum / radius2);
        }
        for (std::size_t i = 0; i < usable; ++i)
            log_density[i] += logs[i];
        ++judged;
    }

    [[nodiscard]] PilotChoice choice(std::size_t usable) const {
        // Among random photons the nearest of sixteen is the least of fifteen uniform numbers: 1/16 on average.
        // Measured: Halton photons 1.3 to 2 times that, random ones 0.95 to 1.05.
        constexpr double stratified_from = 1.15, fewest = 128;
        // The neighbours of a stratified photon keep away from it, so without itself the density there comes out too
        // low, the more so the smaller the disc: the comparison would favour large discs.
        if (seen >= fewest && nearness / seen * 16 > stratified_from)
            return {150, true, false};
        if (judged < fewest)
            return {150, false, false};
        const auto end = log_density.begin() + std::ptrdiff_t(usable);
        const auto best = std::size_t(std::max_element(log_density.begin(), end) - log_density.begin());
        // Twice as many as for an estimate: relaxation restores part of what a pilot blurs, and none of its noise.
        return {2 * candidates[best], false, true};
    }
};

/// Judges candidates at some 4,096 photons, evenly among all.
template <class Cloud, class E>
[[nodiscard]] PilotChoice choose_pilot(const Cloud& cloud, E& executor) {
    using T = typename Cloud::T;
    constexpr std::size_t judges = 4096;
    const std::size_t slots = cloud.tree().slots(), stride = (std::max)(std::size_t(1), slots / judges);
    std::size_t usable = 0; // discs of an eighth of the map at most
    while (usable < PilotEvidence::candidates.size() && 8 * PilotEvidence::candidates[usable] <= slots)
        ++usable;
    if (usable == 1) // nothing to compare it with
        usable = 0;
    const std::size_t wanted = usable > 0 ? PilotEvidence::candidates[usable - 1] : 16;
    std::vector<PilotEvidence> by_leaf(cloud.tree().leaves().size());
    for_each_leaf<std::vector<Neighbour<T>>>(cloud.tree(), executor, [&](auto& nearest, std::uint32_t leaf) {
        const TreeLeaf range = cloud.tree().leaves()[leaf];
        for (std::size_t slot = range.first; slot < range.first + range.size; ++slot) {
            if (slot % stride != 0)
                continue;
            nearest_on_surface(cloud, slot, wanted + 1, nearest);
            std::erase_if(nearest, [&](const auto& other) { return other.slot == slot; });
            std::sort(nearest.begin(), nearest.end(), [](const auto& a, const auto& b) {
                return a.distance2 != b.distance2 ? a.distance2 < b.distance2 : a.slot < b.slot;
            });
            const bool inside =
                nearest.size() >= wanted &&
                surrounded(cloud, slot, std::span(std::as_const(nearest)).first(wanted), nearest[wanted - 1].distance2);
            by_leaf[leaf].add(nearest, usable, inside);
        }
    });
    PilotEvidence all;
    for (const PilotEvidence& evidence : by_leaf)
        all.add(evidence);
    return all.choice(usable);
}

} // namespace nephroid::detail
