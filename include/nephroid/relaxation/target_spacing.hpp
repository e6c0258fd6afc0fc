// SPDX-License-Identifier: MIT
/// @file  The spacing that relaxation aims at, so that it evens out the noise of a caustic and not the caustic itself.
///
/// Distances are measured in units of the local spacing, so that repulsion ends at the local density. That density is a
/// pilot estimate from many neighbours, times a correction by what the pilot blurs
/// [include/nephroid/README.md, "What photons aim at"].
#pragma once

#include "nephroid/relaxation/photon_cloud.hpp"
#include "nephroid/relaxation/photon_constraint.hpp"
#include "nephroid/relaxation/pilot_choice.hpp"
#include "nephroid/relaxation/surrounded.hpp"

#include <algorithm>
#include <span>
#include <vector>

namespace nephroid::detail {

template <class Cloud>
class TargetSpacing {
public:
    using V = typename Cloud::vector;
    using T = scalar_t<V>;

    /// Two look-ups for every photon.
    ///
    /// @param choice       of the pilot estimate, an Epanechnikov kernel that reaches to the last of its neighbours
    /// @param constraints  by slot, or empty: near a feature a pilot averages both of its sides, and is trusted less
    template <class E>
    TargetSpacing(const Cloud& cloud, const PilotChoice& choice, std::span<const PhotonConstraint<V>> constraints,
                  E& executor)
        : pilots_(cloud.tree().slots(), Pilot{T(1), T(0), false}) {
        const std::size_t neighbours = choice.neighbours;
        const double variance = choice.stratified ? 0.02 : 0.2;
        std::vector<T> corrections(pilots_.size(), T(1));
        for_each_disc(cloud, neighbours, executor, [&](std::size_t slot, const Disc& disc) {
            pilots_[slot] = pilot(disc, constraints);
            pilots_[slot].whole = surrounded(cloud, slot, disc.photons, disc.radius2);
        });
        for_each_disc(cloud, neighbours, executor, [&](std::size_t slot, const Disc& disc) {
            corrections[slot] = correction(slot, disc, T(variance));
        });
        for (std::size_t slot = 0; slot < pilots_.size(); ++slot)
            pilots_[slot].root_density = pilots_[slot].root_density * corrections[slot];
    }

    /// The factor, > 0, that turns the squared distance between two photons into one in units of the spacing halfway
    /// between them over that at the first. For densities ρ it is sqrt(ρ₂/ρ₁).
    [[nodiscard]] T factor(std::size_t first, std::size_t second) const {
        const Pilot &a = pilots_[first], &b = pilots_[second];
        return T(1) + a.trust * b.trust *
                          (std::clamp(b.root_density / a.root_density, T(1) / largest_ratio, largest_ratio) - T(1));
    }

private:
    struct Pilot {
        T root_density; ///< square root of photons per area; > 0
        T trust;        ///< 0 at a feature, 1 away from any
        bool whole;     ///< no border of the map crosses its disc
    };

    /// Of the roots of two neighbours' densities: where it is larger, one of the pilots is wrong.
    static constexpr T largest_ratio = T(8);
    static constexpr std::size_t fewest = 16; ///< photons that a pilot needs
    /// The fraction of a disc's photons, by weight, whose pilots a correction needs. Of 76 random photons, the smallest
    /// pilot that a map chooses, a tenth at most seem to lie at a border by chance.
    static constexpr T enough = T(0.75);
    /// The fraction of held photons in a neighbourhood, by weight, from which on its pilot is not trusted at all. A
    /// straight feature through the middle, in a band of 1.5 mean distances to each side, makes it 0.23, which leaves a
    /// quarter of the trust. Measured: with 0.1 soft slopes that look like features are evened out; with no limit edges
    /// become 1.5 to 1.8 times as wide, with this one 1% wider.
    static constexpr T held_at_feature = T(0.3);

    /// The photons about one, each with a weight that falls from 1 to 0 at the rim.
    struct Disc {
        std::span<const Neighbour<T>> photons;
        T radius2;

        [[nodiscard]] T weight(const Neighbour<T>& photon) const { return T(1) - photon.distance2 / radius2; }
    };

    /// Calls use(slot, disc) for each photon but those with too few around them, or all in one place.
    template <class E, class Use>
    static void for_each_disc(const Cloud& cloud, std::size_t neighbours, E& executor, const Use& use) {
        for_each_leaf<std::vector<Neighbour<T>>>(cloud.tree(), executor, [&](auto& nearest, std::uint32_t leaf) {
            const TreeLeaf range = cloud.tree().leaves()[leaf];
            for (std::size_t slot = range.first; slot < range.first + range.size; ++slot) {
                nearest_on_surface(cloud, slot, neighbours, nearest);
                T radius2(0);
                for (const Neighbour<T>& other : nearest)
                    radius2 = (std::max)(radius2, other.distance2);
                if (nearest.size() >= fewest && T(1) / radius2 > T(0) && isfinite(T(1) / radius2))
                    use(slot, Disc{nearest, radius2});
            }
        });
    }

    [[nodiscard]] static Pilot pilot(const Disc& disc, std::span<const PhotonConstraint<V>> constraints) {
        T weights(0), held(0);
        for (const Neighbour<T>& other : disc.photons) {
            const T weight = disc.weight(other);
            weights = weights + weight;
            if (!constraints.empty())
                held = held + weight * constraints[other.slot].weight;
        }
        return {sqrt(weights / disc.radius2), (std::max)(T(0), T(1) - held / (held_at_feature * weights)), false};
    }

    /// What to multiply a photon's root density by: the square root of how many photons lie around it over how many
    /// the pilots there predict, as far as the difference is more than noise.
    ///
    /// Under even light of K random photons this ratio has a variance of 0.2 / K about 1, of stratified ones at most a
    /// tenth of that. Only what lies beyond two standard deviations is used. Photons whose pilots are not trusted tell
    /// nothing, nor do those at a border of the map, whose pilots are too low: taken for detail, that would be made
    /// deeper.
    ///
    /// @param variance  times K
    [[nodiscard]] T correction(std::size_t slot, const Disc& disc, T variance) const {
        T all(0), weights(0), ratios(0);
        for (const Neighbour<T>& other : disc.photons) {
            const T weight = disc.weight(other);
            all = all + weight;
            if (!(pilots_[other.slot].trust > T(0)) || !pilots_[other.slot].whole)
                continue;
            weights = weights + weight;
            ratios = ratios + weight * square(pilots_[slot].root_density / pilots_[other.slot].root_density);
        }
        if (!(weights > enough * all))
            return T(1);
        const T excess = ratios / weights - T(1), noise2 = T(4) * variance / T(disc.photons.size());
        if (!(square(excess) > noise2))
            return T(1);
        return sqrt(std::clamp(T(1) + excess - noise2 / excess, T(0.25), T(4)));
    }

    std::vector<Pilot> pilots_; // by slot
};

} // namespace nephroid::detail
