// SPDX-License-Identifier: MIT
/// @file  The state of photons under relaxation, and one iteration over all of them.
#pragma once

#include "nephroid/relaxation/feature_detector.hpp"
#include "nephroid/relaxation/flux_exchange.hpp"
#include "nephroid/relaxation/leash.hpp"
#include "nephroid/relaxation/neighbourhood.hpp"
#include "nephroid/relaxation/pilot_choice.hpp"
#include "nephroid/relaxation/repulsion.hpp"
#include "nephroid/relaxation/separation.hpp"
#include "nephroid/relaxation/target_spacing.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

namespace nephroid::detail {

/// Moves all photons at once, from a snapshot of their positions: in parallel, and to the same bits for any number of
/// threads.
template <class Cloud>
class Relaxer {
public:
    using V = typename Cloud::vector;
    using T = scalar_t<V>;

    /// Finds the features, if the options say so.
    ///
    /// @param cloud    the photons that the steps move; must outlive this
    /// @param options  must outlive this; checked by the caller
    template <class E>
    Relaxer(Cloud& cloud, const RelaxationOptions& options, E& executor)
        : cloud_(&cloud), options_(&options), reach_(cloud.tree().slots()), radius_(reach_.size()),
          next_radius_(reach_.size()) {
        if (options.constrain)
            constrain(executor);
        pilot_ = {options.pilot_neighbours, false, true};
        if (pilot_.neighbours == RelaxationOptions::chosen_by_map)
            pilot_ = choose_pilot(cloud, executor);
        if (pilot_.neighbours > 0)
            target_.emplace(cloud, pilot_.neighbours, constraints_, executor);
        if (options.flux_diffusion != FluxDiffusion::none)
            exchange_.emplace(cloud, options);
        for (const TreeLeaf& leaf : cloud.tree().leaves())
            guess_reach(cloud.tree(), leaf, search_count(), reach_);
    }

    [[nodiscard]] const PilotChoice& pilot() const { return pilot_; }
    [[nodiscard]] std::size_t searches() const { return searches_; }
    [[nodiscard]] std::size_t constrained_photons() const {
        std::size_t count = 0;
        for (const PhotonConstraint<V>& constraint : constraints_)
            count += constraint.weight > T(0);
        return count;
    }

    /// Moves all photons, and evens out their fluxes if the options say so.
    ///
    /// @param project  project(slot, position relative to the tree's origin) -> where the photon goes instead
    /// @return  the sum over all photons of the length of the move over the radius of the neighbourhood
    template <class E, class Project>
    double step(unsigned iteration, E& executor, const Project& project) {
        if (iteration == 0) {
            leash_.emplace(cloud_->tree(), T(options_->leash));
            next_ = leash_->starts();
        }
        const T relaxation =
            T(over_relaxation(iteration, options_->iterations, options_->over_relaxation, options_->final_relaxation));
        const T fraction = T(step_fraction(iteration, options_->iterations, options_->final_step));
        std::vector<double> moves(cloud_->tree().leaves().size());
        const auto advance = [&](std::uint32_t leaf, std::size_t slot, std::span<Neighbour<T>> found) {
            const V from = cloud_->position(slot);
            const std::span<const Neighbour<T>> pushing = in_spacings(slot, found);
            // With fewer than K + 1 others there is no disc: the photon stays.
            const bool alone = pushing.size() < std::size_t(options_->neighbours + 1);
            T radius = alone ? T(0) : sqrt(pushing.back().distance2);
            const bool heap = !alone && !(radius > T(0));
            if (heap)
                radius = distance_to_others(*cloud_, slot);
            V to = from;
            if (radius > T(0)) {
                if (iteration == 0)
                    leash_->set_radius(slot, radius);
                const T limit_radius = iteration > 0 && radius_[slot] > T(0) ? radius_[slot] : radius;
                const V step = fraction * move(slot, pushing, radius, relaxation, limit_radius, heap);
                to = leash_->held(slot, from, project(slot, V(from + step)));
                moves[leaf] += double(length(V(to - from)) / radius);
            }
            using t = vector_traits<V>;
            next_[0][slot] = t::x(to), next_[1][slot] = t::y(to), next_[2][slot] = t::z(to);
        };
        for_each_neighbourhood(executor, advance);
        exchange_flux(executor);
        cloud_->tree().refit(next_, executor);
        radius_.swap(next_radius_);
        return std::accumulate(moves.begin(), moves.end(), 0.0);
    }

private:
    template <class E>
    void constrain(E& executor) {
        FeatureDetector<Cloud> detector(*cloud_, *options_);
        detector.run(executor);
        searches_ = detector.searches();
        constraints_.assign(cloud_->tree().slots(), {zero_vector<V>(), T(0)});
        for_each_slot(cloud_->tree(), executor,
                      [&](std::size_t slot) { constraints_[slot] = detector.constraint(slot); });
    }

    /// Evens out the fluxes between the neighbours found last.
    template <class E>
    void exchange_flux(E& executor) {
        if (exchange_)
            exchange_->run(*cloud_, constraints_, next_radius_, options_->flux_diffusion, executor);
    }

    /// How many neighbours are searched for: with target spacings twice as many as push a photon, as some of the
    /// farther ones may be nearer in units of the spacing.
    [[nodiscard]] std::size_t search_count() const { return (target_ ? 2 : 1) * std::size_t(options_->neighbours + 1); }

    /// Calls visit(leaf, slot, neighbours) for all photons, with neighbours that `visit` may reorder; keeps the radii
    /// and the partners of flux exchange.
    template <class E, class Visit>
    void for_each_neighbourhood(E& executor, const Visit& visit) {
        const std::size_t pushing = options_->neighbours + 1;
        for_each_leaf<Neighbourhood<Cloud>>(cloud_->tree(), executor, [&](auto& neighbourhood, std::uint32_t leaf) {
            neighbourhood.for_each(*cloud_, leaf, search_count(), reach_,
                                   [&](std::size_t slot, std::span<Neighbour<T>> found) {
                                       const auto first = found.first((std::min)(pushing, found.size()));
                                       next_radius_[slot] = found.empty() ? T(0) : sqrt(first.back().distance2);
                                       reach_[slot] = found.empty() ? T(0) : sqrt(found.back().distance2);
                                       if (exchange_)
                                           exchange_->set_partners(slot, first);
                                       visit(leaf, slot, found);
                                   });
        });
    }

    /// Sorts the neighbours found by their distances in units of the target spacing.
    /// @return  those that push the photon, and one more
    [[nodiscard]] std::span<const Neighbour<T>> in_spacings(std::size_t slot, std::span<Neighbour<T>> found) const {
        if (!target_)
            return found;
        for (Neighbour<T>& other : found)
            other.distance2 = other.distance2 * target_->factor(slot, other.slot);
        std::sort(found.begin(), found.end(), [](const Neighbour<T>& a, const Neighbour<T>& b) {
            return a.distance2 != b.distance2 ? a.distance2 < b.distance2 : a.slot < b.slot;
        });
        return found.first((std::min)(std::size_t(options_->neighbours + 1), found.size()));
    }

    /// The force on a photon [eq. 1 and 3], constrained and damped [eq. 10 and 11].
    ///
    /// @param found         nearest first; the last one gives the radius and does not push
    /// @param limit_radius  r_p of eq. 11: the radius of the iteration before, which avoids artefacts
    /// @param heap          the neighbours lie where the photon does: a feature, but one that would hold them for ever
    [[nodiscard]] V move(std::size_t slot, std::span<const Neighbour<T>> found, T radius, T relaxation, T limit_radius,
                         bool heap) const {
        const V position = cloud_->position(slot);
        V force = zero_vector<V>();
        for (std::size_t k = 0; k + 1 < found.size(); ++k) {
            const auto [distance2, other] = found[k];
            force = force + (distance2 > T(0) ? repulsion<V>(position - cloud_->position(other), sqrt(distance2),
                                                             radius * relaxation)
                                              : radius * relaxation * separation_direction(*cloud_, slot, other));
        }
        force = in_tangent_plane<V>(T(1) / T(options_->neighbours) * force, cloud_->normal(slot));
        if (heap) // or the damping, which takes them for far too strong, would leave most where they are
            force = (T(0.25) * radius / (std::max)(T(0.25) * radius, T(length(force)))) * force;
        else if (!constraints_.empty() && found.front().distance2 > T(0)) // two in one place part along an edge or not
            force = constrained(force, constraints_[slot]);
        if (options_->rho > 0)
            force = diffusion_limit<T>(length2(force), square(limit_radius), T(options_->rho)) * force;
        return force;
    }

    Cloud* cloud_;
    const RelaxationOptions* options_;
    std::vector<PhotonConstraint<V>> constraints_; // by slot, as all of these; empty without constraints
    std::vector<T> reach_;                         ///< distance of the last neighbour that the last search found
    std::vector<T> radius_, next_radius_;          ///< of the disc of K + 1
    std::array<std::vector<T>, 3> next_;           ///< positions
    std::optional<Leash<T>> leash_;
    std::optional<TargetSpacing<Cloud>> target_;
    std::optional<FluxExchange<Cloud>> exchange_;
    PilotChoice pilot_{0, false, true};
    std::size_t searches_ = 0;
};

} // namespace nephroid::detail
