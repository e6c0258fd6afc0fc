// SPDX-License-Identifier: MIT
/// @file  A photon's walk: from the lamp through mirrors and glass to the surfaces where its light is seen. One for all
///        methods: a visitor says what of it they want to know.
#pragma once

#include "nephroid/transport/account.hpp"
#include "nephroid/transport/visited_walk.hpp"
#include "nephroid/transport/visitor.hpp"
#include "nephroid/transport/walk_limits.hpp"

#include <cstddef>
#include <optional>
#include <type_traits>
#include <utility>

namespace nephroid {

/// Follows one photon, and tells a visitor what happens to it.
///
/// @param scene    the renderer's, see `Scene`
/// @param photon   as emitted; used up
/// @param sampler  the photon's own stream of numbers, from which the scene and Russian roulette draw
/// @param limits   on the path
/// @param account  gets the photon's flux by reason, except for what is deposited: that is the caller's to book. With
///                 it, `emitted` is the sum of all fates; photons are `emitted` and `branches`
/// @param visitor  flights, surfaces, deposits, all ways: as far as it has members for them (transport/visitor.hpp)
/// @return  nothing if the visitor takes the deposits; else as below
/// Does not throw unless the scene or the visitor does.
template <class S, Vector3 V, Flux F, std::size_t N, class Sampler, class Visitor>
    requires(detail::MustBeScene<S, V, Sampler, N>&& detail::MustVisit<std::remove_reference_t<Visitor>, S, V, F, N>)
auto walk(const S& scene, Photon<V, F, N>&& photon, Sampler& sampler, const WalkLimits& limits, Statistics& account,
          Visitor&& visitor) {
    static_assert(
        Absorbs<S, V> || !requires { typename S::medium; },
        "nephroid::walk: the scene names a medium, but transmittance(medium, distance) is missing or not const");
    using Visits = std::remove_reference_t<Visitor>;
    std::optional<Deposit<V, F, N>> kept;
    detail::VisitedWalk<S, V, F, N, Sampler, Visits>(scene, photon, sampler, limits, account, visitor).run(kept);
    if constexpr (!detail::VisitsDeposits<Visits, V, F, N>)
        return kept;
}

/// The same, for a photon that stays as it was.
template <class S, Vector3 V, Flux F, std::size_t N, class Sampler, class Visitor>
    requires(detail::MustBeScene<S, V, Sampler, N>&& detail::MustVisit<std::remove_reference_t<Visitor>, S, V, F, N>)
auto walk(const S& scene, const Photon<V, F, N>& photon, Sampler& sampler, const WalkLimits& limits,
          Statistics& account, Visitor&& visitor) {
    Photon<V, F, N> walker = photon;
    return walk(scene, std::move(walker), sampler, limits, account, std::forward<Visitor>(visitor));
}

/// Follows one photon along its specular path to the diffuse surface where it ends.
///
/// @return  the photon where it is to be splatted; nothing if it ended otherwise, which is then in the account
template <class S, Vector3 V, Flux F, std::size_t N, class Sampler>
    requires detail::MustBeScene<S, V, Sampler, N>
[[nodiscard]] std::optional<Deposit<V, F, N>> walk(const S& scene, Photon<V, F, N>&& photon, Sampler& sampler,
                                                   const WalkLimits& limits, Statistics& account) {
    return walk(scene, std::move(photon), sampler, limits, account, NoVisitor());
}

/// The same, for a photon that stays as it was.
template <class S, Vector3 V, Flux F, std::size_t N, class Sampler>
    requires detail::MustBeScene<S, V, Sampler, N>
[[nodiscard]] std::optional<Deposit<V, F, N>> walk(const S& scene, const Photon<V, F, N>& photon, Sampler& sampler,
                                                   const WalkLimits& limits, Statistics& account) {
    return walk(scene, photon, sampler, limits, account, NoVisitor());
}

} // namespace nephroid
