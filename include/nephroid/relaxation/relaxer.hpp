// SPDX-License-Identifier: MIT
/// @file  Photons under relaxation: their state, and one iteration over all of them.
#pragma once

#include "nephroid/relaxation/detect_features.hpp"
#include "nephroid/relaxation/flux_exchange.hpp"
#include "nephroid/relaxation/neighbourhood.hpp"
#include "nephroid/relaxation/parting.hpp"
#include "nephroid/relaxation/repulsion.hpp"
#include "nephroid/relaxation/target_spacing.hpp"

#include <optional>

namespace nephroid::detail {

/// All photons move at once, from a snapshot of their positions: in parallel, and to the same bits for any number of
/// threads.
template <class Cloud>
class Relaxer {
public:
    using V = typename Cloud::vector;
    using T = scalar_t<V>;

    /// Finds the features, if options say so.
    ///
    /// @param cloud    is moved by the steps, and must outlive this
    /// @param options  must outlive this; checked by the caller
    template <class E>
    Relaxer(Cloud& cloud, const RelaxationOptions& options, E& executor)
        : cloud_(&cloud), options_(&options), reach_(cloud.tree().slots()), radius_(reach_.size()),
          next_radius_(reach_.size()) {
        if (options.constrain)
            constrain(executor);
        if (options.pilot_neighbours > 0)
            target_.emplace(cloud, options.pilot_neighbours, constraints_, executor);
        if (options.flux_diffusion != FluxDiffusion::none)
            exchange_.emplace(cloud, options);
        for (const TreeLeaf& leaf : cloud.tree().leaves())
            guess_reach(leaf);
    }

    [[nodiscard]] std::size_t searches() const { return searches_; }
    [[nodiscard]] std::size_t constrained_photons() const {
        std::size_t count = 0;
        for (const PhotonConstraint<V>& constraint : constraints_)
            count += constraint.weight > T(0);
        return count;
    }

    /// Moves all photons, and evens out their fluxes if options say so.
    ///
    /// @param project  project(slot, position relative to the tree's origin) -> where the photon goes instead
    /// @return  the sum over all photons of the move over the radius of the neighbourhood
    template <class E, class Project>
    double step(unsigned iteration, E& executor, const Project& project) {
        if (iteration == 0)
            remember_start();
        const T relaxation =
            T(over_relaxation(iteration, options_->iterations, options_->over_relaxation, options_->final_relaxation));
        const T share = T(step_share(iteration, options_->iterations, options_->final_step));
        std::vector<double> moves(cloud_->tree().leaves().size());
        const auto advance = [&](std::uint32_t leaf, std::size_t slot, std::span<Neighbour<T>> found) {
            const V from = cloud_->position(slot);
            const std::span<const Neighbour<T>> pushing = by_target(slot, found);
            T radius = pushing.empty() ? T(0) : sqrt(pushing.back().distance2);
            if (!(radius > T(0)))
                radius = radius_apart(slot);
            V to = from;
            if (radius > T(0)) {
                if (iteration == 0)
                    first_radius_[slot] = radius;
                const T limit_radius = iteration > 0 && radius_[slot] > T(0) ? radius_[slot] : radius;
                const V step = share * move(slot, pushing, radius, relaxation, limit_radius);
                to = leashed(slot, from, project(slot, V(from + step)));
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

    /// Evens out the fluxes where the photons are.
    template <class E>
    void diffuse(E& executor) {
        for_each_neighbourhood(executor, [](std::uint32_t, std::size_t, std::span<Neighbour<T>>) {});
        exchange_flux(executor);
    }

    /// The same again, for photons that have not moved.
    template <class E>
    void exchange_flux(E& executor) {
        if (exchange_)
            exchange_->run(*cloud_, constraints_, next_radius_, options_->flux_diffusion, executor);
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

    /// As if the photons of a leaf filled the two longer sides of its box.
    void guess_reach(const TreeLeaf& leaf) {
        std::array<T, 3> side;
        const T* const coordinates[3] = {cloud_->tree().x(), cloud_->tree().y(), cloud_->tree().z()};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const T* const first = coordinates[axis] + leaf.first;
            const auto [low, high] = std::minmax_element(first, first + leaf.size);
            side[axis] = *high - *low;
        }
        std::sort(side.begin(), side.end());
        const T wanted = T(looked_for()), area = side[2] * (std::max)(side[1], side[2] / T(leaf.size));
        std::fill_n(reach_.begin() + leaf.first, leaf.size, sqrt(wanted * area / (pi<T> * T(leaf.size))));
    }

    void remember_start() {
        const PointTree<V>& tree = cloud_->tree();
        start_ = {std::vector<T>(tree.x(), tree.x() + tree.slots()), std::vector<T>(tree.y(), tree.y() + tree.slots()),
                  std::vector<T>(tree.z(), tree.z() + tree.slots())};
        next_ = start_;
        first_radius_.assign(tree.slots(), T(0));
    }

    /// How many neighbours are looked for: of as many again as push a photon some may be nearer to it by their targets.
    [[nodiscard]] std::size_t looked_for() const { return (target_ ? 2 : 1) * std::size_t(options_->neighbours + 1); }

    /// Calls visit(leaf, slot, neighbours) for all photons, with neighbours that visit may put in another order; notes
    /// the radii and whom flux may be exchanged with.
    template <class E, class Visit>
    void for_each_neighbourhood(E& executor, const Visit& visit) {
        const std::size_t pushing = options_->neighbours + 1;
        for_each_leaf<Neighbourhood<Cloud>>(cloud_->tree(), executor, [&](auto& neighbourhood, std::uint32_t leaf) {
            neighbourhood.for_each(*cloud_, leaf, looked_for(), reach_,
                                   [&](std::size_t slot, std::span<Neighbour<T>> found) {
                                       const auto first = found.first((std::min)(pushing, found.size()));
                                       next_radius_[slot] = found.empty() ? T(0) : sqrt(first.back().distance2);
                                       reach_[slot] = found.empty() ? T(0) : sqrt(found.back().distance2);
                                       if (exchange_)
                                           exchange_->note(slot, first);
                                       visit(leaf, slot, found);
                                   });
        });
    }

    /// Where K + 1 photons are in one place: the distance to the nearest of the crowd that is not, 0 if there is none.
    [[nodiscard]] T radius_apart(std::size_t slot) const {
        std::vector<Neighbour<T>> crowd(8 * (options_->neighbours + 1));
        crowd.resize(cloud_->tree().nearest(cloud_->position(slot), crowd));
        T distance2(0);
        for (const Neighbour<T>& other : crowd)
            if (other.distance2 > T(0) && !(distance2 > T(0) && distance2 < other.distance2))
                distance2 = other.distance2;
        return sqrt(distance2);
    }

    /// The neighbours that push a photon and the one after them, by the distances that their targets make of theirs.
    [[nodiscard]] std::span<const Neighbour<T>> by_target(std::size_t slot, std::span<Neighbour<T>> found) const {
        if (!target_)
            return found;
        for (Neighbour<T>& other : found)
            other.distance2 = other.distance2 * target_->factor(slot, other.slot);
        std::sort(found.begin(), found.end(), [](const Neighbour<T>& a, const Neighbour<T>& b) {
            return a.distance2 != b.distance2 ? a.distance2 < b.distance2 : a.slot < b.slot;
        });
        return found.first((std::min)(std::size_t(options_->neighbours + 1), found.size()));
    }

    /// The force on a photon [eq. 1 and 3], as far as it follows it [eq. 10 and 11].
    ///
    /// @param found         nearest first; the last one tells the radius
    /// @param limit_radius  r_p of eq. 11: of the iteration before, which keeps artefacts out
    [[nodiscard]] V move(std::size_t slot, std::span<const Neighbour<T>> found, T radius, T relaxation,
                         T limit_radius) const {
        const V position = cloud_->position(slot);
        V force = zero_vector<V>();
        for (std::size_t k = 0; k + 1 < found.size(); ++k) {
            const auto [distance2, other] = found[k];
            force = force + (distance2 > T(0) ? repulsion<V>(position - cloud_->position(other), sqrt(distance2),
                                                             radius * relaxation)
                                              : radius * relaxation * parting(*cloud_, slot, other));
        }
        force = in_tangent_plane<V>(T(1) / T(options_->neighbours) * force, cloud_->normal(slot));
        if (!constraints_.empty())
            force = constrained(force, constraints_[slot]);
        if (options_->rho > 0)
            force = diffusion_limit<T>(length2(force), square(limit_radius), T(options_->rho)) * force;
        return force;
    }

    /// Where it goes, or where it is if that is too far from where it began.
    [[nodiscard]] V leashed(std::size_t slot, const V& from, const V& to) const {
        const V start = make_vector<V>(start_[0][slot], start_[1][slot], start_[2][slot]);
        return length2(V(to - start)) <= square(T(options_->leash) * first_radius_[slot]) ? to : from;
    }

    Cloud* cloud_;
    const RelaxationOptions* options_;
    std::vector<PhotonConstraint<V>> constraints_; // by slot, as all of these; empty without constraints
    std::vector<T> reach_; ///< to the last of the neighbours that are looked for, when they were last looked for
    std::vector<T> radius_, next_radius_, first_radius_; ///< of the disc of K + 1
    std::array<std::vector<T>, 3> start_, next_;
    std::optional<TargetSpacing<Cloud>> target_;
    std::optional<FluxExchange<Cloud>> exchange_;
    std::size_t searches_ = 0;
};

} // namespace nephroid::detail
