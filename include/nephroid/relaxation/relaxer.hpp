// SPDX-License-Identifier: MIT
/// @file  The state of photons under relaxation, and one iteration over all of them.
#pragma once

#include "nephroid/relaxation/feature_detector.hpp"
#include "nephroid/relaxation/first_discs.hpp"
#include "nephroid/relaxation/flux_exchange.hpp"
#include "nephroid/relaxation/leash.hpp"
#include "nephroid/relaxation/neighbourhood.hpp"
#include "nephroid/relaxation/photon_move.hpp"
#include "nephroid/relaxation/pilot_choice.hpp"
#include "nephroid/relaxation/target_spacing.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

namespace nephroid::detail {

/// Moves photons in turn: in parallel, and to the same bits for any number of threads.
///
/// The tree's leaves have four turns, one after the other. Within a leaf photons move one after another, and see where
/// those before them went; leaves that share a turn see each other as they were before it, and seldom touch
/// [include/nephroid/README.md, "Photons in turn"].
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
          next_radius_(reach_.size()), leash_(cloud.tree(), T(options.leash)), next_(leash_.starts()) {
        if (options.constrain)
            constrain(executor);
        pilot_ = {options.pilot_neighbours, false, true};
        if (pilot_.neighbours == RelaxationOptions::chosen_by_map)
            pilot_ = choose_pilot(cloud, executor);
        if (pilot_.neighbours > 0)
            target_.emplace(cloud, pilot_, constraints_, executor);
        if (options.flux_diffusion != FluxDiffusion::none)
            exchange_.emplace(cloud, options);
        measure_first_discs(cloud, options.neighbours, search_count(), reach_, leash_, executor);
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
        const T relaxation =
            T(over_relaxation(iteration, options_->iterations, options_->over_relaxation, options_->final_relaxation));
        const T fraction = T(step_fraction(iteration, options_->iterations, options_->final_step));
        std::vector<double> moves(cloud_->tree().leaves().size());
        const auto advance = [&](const auto& around, std::uint32_t leaf, std::size_t slot,
                                 std::span<Neighbour<T>> found) -> V {
            const V from = cloud_->position(slot);
            Push<Cloud> push{slot, in_spacings(slot, found), T(0), T(0), false};
            // With fewer than K + 1 others there is no disc: the photon stays.
            const bool alone = push.neighbours.size() < std::size_t(options_->neighbours + 1);
            push.radius = alone ? T(0) : sqrt(push.neighbours.back().distance2);
            push.heap = !alone && !(push.radius > T(0));
            if (push.heap)
                push.radius = leash_.radius(slot); // those that left the heap before are too near to measure by
            if (!(push.radius > T(0)))
                return from;
            push.limit_radius = iteration > 0 && radius_[slot] > T(0) ? radius_[slot] : push.radius;
            const PhotonConstraint<V>* const constraint = constraints_.empty() ? nullptr : &constraints_[slot];
            const V move = fraction * move_of(*cloud_, around, push, relaxation, constraint, T(options_->rho));
            const V to = leash_.held(slot, from, project(slot, V(from + move)));
            moves[leaf] += double(length(V(to - from)) / push.radius);
            return to;
        };
        for (std::uint32_t turn = 0; turn < turns; ++turn) {
            for_each_neighbourhood(turn, executor, advance);
            cloud_->tree().refit(next_, executor);
            keep_moves(turn, executor);
        }
        if (exchange_) {
            exchange_->find_partners(*cloud_, next_radius_, executor);
            exchange_->run(*cloud_, constraints_, options_->flux_diffusion, executor);
        }
        radius_.swap(next_radius_);
        return std::accumulate(moves.begin(), moves.end(), 0.0);
    }

private:
    /// Consecutive leaves lie side by side: those that share a turn are seldom neighbours.
    static constexpr std::uint32_t turns = 4;

    template <class E>
    void constrain(E& executor) {
        FeatureDetector<Cloud> detector(*cloud_, *options_);
        detector.run(executor);
        searches_ = detector.searches();
        constraints_.assign(cloud_->tree().slots(), {zero_vector<V>(), T(0)});
        for_each_slot(cloud_->tree(), executor,
                      [&](std::size_t slot) { constraints_[slot] = detector.constraint(slot); });
    }

    /// How many neighbours are searched for: with target spacings twice as many as push a photon, as some of the
    /// farther ones may be nearer in units of the spacing.
    [[nodiscard]] std::size_t search_count() const { return (target_ ? 2 : 1) * std::size_t(options_->neighbours + 1); }

    /// Calls visit(neighbourhood, leaf, slot, neighbours) for the photons that have this turn, with neighbours that
    /// `visit` may reorder, and notes where it moves them and their radii.
    template <class E, class Visit>
    void for_each_neighbourhood(std::uint32_t turn, E& executor, const Visit& visit) {
        const std::size_t pushing = options_->neighbours + 1;
        const auto move_leaf = [&](auto& around, std::uint32_t leaf) {
            around.for_each(*cloud_, leaf, search_count(), reach_,
                            [&](std::size_t slot, std::span<Neighbour<T>> found) -> V {
                                const std::size_t last = (std::min)(pushing, found.size());
                                next_radius_[slot] = last == 0 ? T(0) : sqrt(found[last - 1].distance2);
                                reach_[slot] = found.empty() ? T(0) : sqrt(found.back().distance2);
                                const V to = visit(around, leaf, slot, found);
                                using t = vector_traits<V>;
                                next_[0][slot] = t::x(to), next_[1][slot] = t::y(to), next_[2][slot] = t::z(to);
                                return to;
                            });
        };
        for_each_leaf<Neighbourhood<Cloud>>(cloud_->tree(), executor, move_leaf, turn, turns);
    }

    /// Copies where this turn's photons went to `next_`, which the tree exchanged for the positions before the turn.
    template <class E>
    void keep_moves(std::uint32_t turn, E& executor) {
        const PointTree<V>& tree = cloud_->tree();
        const T* const moved[3] = {tree.x(), tree.y(), tree.z()};
        const auto copy_leaf = [&](NoScratch, std::uint32_t leaf) {
            const TreeLeaf range = tree.leaves()[leaf];
            for (std::size_t axis = 0; axis < 3; ++axis)
                std::copy_n(moved[axis] + range.first, range.size, next_[axis].begin() + std::ptrdiff_t(range.first));
        };
        for_each_leaf<NoScratch>(tree, executor, copy_leaf, turn, turns);
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

    Cloud* cloud_;
    const RelaxationOptions* options_;
    std::vector<PhotonConstraint<V>> constraints_; // by slot, as all of these; empty without constraints
    std::vector<T> reach_;                         ///< distance of the last neighbour that the last search found
    std::vector<T> radius_, next_radius_;          ///< of the disc of K + 1
    Leash<T> leash_;
    std::array<std::vector<T>, 3> next_; ///< positions
    std::optional<TargetSpacing<Cloud>> target_;
    std::optional<FluxExchange<Cloud>> exchange_;
    PilotChoice pilot_{0, false, true};
    std::size_t searches_ = 0;
};

} // namespace nephroid::detail
