// SPDX-License-Identifier: MIT
/// @file  Flux evened out between neighbouring photons, not across features: Section 3.4 of Spencer and Jones 2009.
#pragma once

#include "nephroid/relaxation/flux_discontinuity.hpp"
#include "nephroid/relaxation/neighbourhood.hpp"
#include "nephroid/relaxation/options.hpp"
#include "nephroid/relaxation/photon_cloud.hpp"
#include "nephroid/relaxation/photon_constraint.hpp"

#include <span>
#include <vector>

namespace nephroid::detail {

/// The fraction of the flux between two photons that the constraint of one of them lets pass [the second factor of
/// eq. 13]: all of it along the feature or without one, none across.
///
/// @param offset    from one to the other, either way
/// @param distance  its length, > 0
template <Vector3 V>
[[nodiscard]] scalar_t<V> permeability(const PhotonConstraint<V>& constraint, const V& offset, scalar_t<V> distance) {
    using T = scalar_t<V>;
    // Normalised, unlike the paper's offset: else the weight would depend on the unit of length.
    const T along = abs(dot(constraint.direction, offset)) / distance;
    return constraint.weight * along + (T(1) - constraint.weight);
}

/// One step of flux diffusion over all photons, from a snapshot of their fluxes.
template <class Cloud>
class FluxExchange {
public:
    using V = typename Cloud::vector;
    using F = typename Cloud::flux_type;
    using T = scalar_t<V>;

    FluxExchange(const Cloud& cloud, const RelaxationOptions& options)
        : neighbours_(options.neighbours), alpha_(options.alpha), beta_(options.beta),
          partners_(neighbours_ * cloud.tree().slots(), no_photon), next_(cloud.fluxes()) {}

    /// Finds each photon's partners, with which it exchanges flux, from where the photons are now. If one is a partner
    /// of another, so is the other of the one.
    ///
    /// @param guess  by slot: about how far the last of K + 1 neighbours lies; any
    template <class E>
    void find_partners(const Cloud& cloud, std::span<const T> guess, E& executor) {
        radius_.assign(guess.begin(), guess.end());
        for_each_leaf<Neighbourhood<Cloud>>(cloud.tree(), executor, [&](auto& around, std::uint32_t leaf) {
            around.for_each(
                cloud, leaf, neighbours_ + 1, radius_, [&](std::size_t slot, std::span<const Neighbour<T>> found) {
                    radius_[slot] = found.empty() ? T(0) : sqrt(found.back().distance2);
                    for (std::size_t k = 0; k < neighbours_; ++k) // the last one ends the kernel
                        partners_[slot * neighbours_ + k] = k + 1 < found.size() ? found[k].slot : no_photon;
                });
        });
    }

    /// Replaces all fluxes, between the partners found last.
    ///
    /// @param constraints  by slot, or empty
    template <class E>
    void run(Cloud& cloud, std::span<const PhotonConstraint<V>> constraints, FluxDiffusion method, E& executor) {
        for_each_slot(cloud.tree(), executor, [&](std::size_t slot) {
            next_[slot] = method == FluxDiffusion::conserving ? exchanged(cloud, constraints, radius_, slot)
                                                              : weighted_mean(cloud, constraints, radius_, slot);
        });
        cloud.fluxes().swap(next_);
    }

private:
    static constexpr std::uint32_t no_photon = (std::numeric_limits<std::uint32_t>::max)();

    [[nodiscard]] std::span<const std::uint32_t> partners(std::size_t slot) const {
        return {partners_.data() + slot * neighbours_, neighbours_};
    }

    /// The fraction that both constraints let pass. The weights of eq. 13 let half of the flux cross an edge obliquely.
    /// At features, therefore, photons exchange less the more their fluxes differ, by the same measure as two sides of
    /// a feature [eq. 8], which changes nothing along edges of density alone.
    [[nodiscard]] T mutual_permeability(const Cloud& cloud, std::span<const PhotonConstraint<V>> constraints,
                                        std::size_t slot, std::size_t other, const V& offset, T distance) const {
        if (constraints.empty())
            return T(1);
        const T held = (std::max)(constraints[slot].weight, constraints[other].weight);
        if (!(held > T(0)))
            return T(1);
        const T through = (std::min)(permeability(constraints[slot], offset, distance),
                                     permeability(constraints[other], offset, distance));
        const double homogeneity = flux_homogeneity(cloud.flux(slot), cloud.flux(other));
        return through * (T(1) - held * T(constraint_weight(homogeneity, alpha_, beta_)));
    }

    /// Eq. 12 and 13.
    [[nodiscard]] F weighted_mean(const Cloud& cloud, std::span<const PhotonConstraint<V>> constraints,
                                  std::span<const T> radius, std::size_t slot) const {
        F sum = cloud.flux(slot);
        T weights(1);
        for (const std::uint32_t other : partners(slot)) {
            if (other == no_photon)
                break;
            const V offset = cloud.position(slot) - cloud.position(other);
            const T distance = length(offset);
            if (!(distance > T(0) && distance < radius[slot]))
                continue;
            const T through = constraints.empty() ? T(1) : permeability(constraints[other], offset, distance);
            const T weight = (T(1) - square(distance / radius[slot])) * through;
            sum = sum + static_cast<F>(cloud.flux(other) * weight);
            weights = weights + weight;
        }
        return static_cast<F>(sum * (T(1) / weights));
    }

    /// A photon's flux after it gave each partner a fraction of the difference and got the same from it. Both photons
    /// of a pair use the same fraction: the kernel ends at the smaller of their two radii, within which each is a
    /// partner of the other, and the permeability is symmetric. With fractions of at most 1/(K + 1) no flux overshoots.
    [[nodiscard]] F exchanged(const Cloud& cloud, std::span<const PhotonConstraint<V>> constraints,
                              std::span<const T> radius, std::size_t slot) const {
        F flux = cloud.flux(slot);
        for (const std::uint32_t other : partners(slot)) {
            if (other == no_photon)
                break;
            const T reach = (std::min)(radius[slot], radius[other]);
            const V offset = cloud.position(slot) - cloud.position(other);
            const T distance = length(offset);
            if (!(distance > T(0) && distance < reach))
                continue;
            const T through = mutual_permeability(cloud, constraints, slot, other, offset, distance);
            const T fraction = (T(1) - square(distance / reach)) * through / T(neighbours_ + 1);
            flux = flux + static_cast<F>(static_cast<F>(cloud.flux(other) * fraction) +
                                         static_cast<F>(cloud.flux(slot) * -fraction));
        }
        return flux;
    }

    std::size_t neighbours_;
    double alpha_, beta_;                 ///< of eq. 8
    std::vector<std::uint32_t> partners_; // by slot, `neighbours_` for each
    std::vector<T> radius_;               ///< by slot, of the last of its K + 1 neighbours
    std::vector<F> next_;
};

} // namespace nephroid::detail
