// SPDX-License-Identifier: MIT
/// @file  A photon's walk: from the lamp through mirrors and glass to the surfaces where its light is seen. All methods
///        use this walk; a visitor gives them the parts that they need.
#pragma once

#include "nephroid/emission/parameters.hpp"
#include "nephroid/transport/account.hpp"
#include "nephroid/transport/parametric_scene.hpp"
#include "nephroid/transport/visited_walk.hpp"
#include "nephroid/transport/visitor.hpp"
#include "nephroid/transport/visitor_checks.hpp"
#include "nephroid/transport/walk_limits.hpp"

#include <cstddef>
#include <optional>
#include <type_traits>
#include <utility>

namespace nephroid {

/// Follows one photon, and calls a visitor at each step.
///
/// @param scene    the renderer's, see `Scene`
/// @param photon   as emitted; changed by the walk
/// @param sampler  the photon's own stream of numbers, from which the scene and Russian roulette draw
/// @param limits   on the path
/// @param account  gets the photon's flux under its fate, except for deposits, which the caller books. Then the fates'
///                 fluxes add up to the emitted one, and their photons to `emitted.photons` + `branches`
/// @param visitor  its members for flights, surfaces and deposits are called (transport/visitor.hpp)
/// @return  void if the visitor takes the deposits; otherwise as below
/// Does not throw unless the scene or the visitor does.
template <class S, Vector3 V, Flux F, std::size_t N, class Sampler, class Visitor>
    requires(detail::MustBeScene<S, V, Sampler, N>&& detail::MustVisit<std::remove_reference_t<Visitor>, S, V, F, N>)
auto walk(const S& scene, Photon<V, F, N>&& photon, Sampler& sampler, const WalkLimits& limits, Statistics& account,
          Visitor&& visitor) {
    static_assert(
        Absorbs<S, V> || !requires { typename S::medium; },
        "nephroid::walk: the scene names a medium, but transmittance(medium, distance) is missing or not const");
    using Visits = std::remove_reference_t<Visitor>;
    static_assert(!detail::follows_all_ways<Visits> || !detail::ForgetsMediumInAllWays<S, V, Sampler>,
                  "nephroid::walk: the scene's scatter takes the medium, but its scatter_all does not; add a third "
                  "parameter for it (transport/ways.hpp)");
    std::optional<Deposit<V, F, N>> kept;
    detail::VisitedWalk<S, V, F, N, Sampler, Visits>(scene, photon, sampler, limits, account, visitor).run(kept);
    if constexpr (!detail::VisitsDeposits<Visits, V, F, N>)
        return kept;
}

/// The same, for a photon that the walk copies and does not change.
template <class S, Vector3 V, Flux F, std::size_t N, class Sampler, class Visitor>
    requires(detail::MustBeScene<S, V, Sampler, N>&& detail::MustVisit<std::remove_reference_t<Visitor>, S, V, F, N>)
auto walk(const S& scene, const Photon<V, F, N>& photon, Sampler& sampler, const WalkLimits& limits,
          Statistics& account, Visitor&& visitor) {
    Photon<V, F, N> walker = photon;
    return walk(scene, std::move(walker), sampler, limits, account, std::forward<Visitor>(visitor));
}

/// Follows one photon along its specular path to the diffuse surface where it ends.
///
/// @return  the photon where it is to be splatted; nothing if it ended in another way, which the account then shows
template <class S, Vector3 V, Flux F, std::size_t N, class Sampler>
    requires detail::MustBeScene<S, V, Sampler, N>
[[nodiscard]] std::optional<Deposit<V, F, N>> walk(const S& scene, Photon<V, F, N>&& photon, Sampler& sampler,
                                                   const WalkLimits& limits, Statistics& account) {
    return walk(scene, std::move(photon), sampler, limits, account, NoVisitor());
}

/// The same, for a photon that the walk copies and does not change.
template <class S, Vector3 V, Flux F, std::size_t N, class Sampler>
    requires detail::MustBeScene<S, V, Sampler, N>
[[nodiscard]] std::optional<Deposit<V, F, N>> walk(const S& scene, const Photon<V, F, N>& photon, Sampler& sampler,
                                                   const WalkLimits& limits, Statistics& account) {
    return walk(scene, photon, sampler, limits, account, NoVisitor());
}

/// The same for a photon with parameters, which the scene's functions get as a last argument if they take one.
///
/// @param photon   changed by the walk, its parameters included
/// @param visitor  may be left out
template <class S, Vector3 V, Flux F, std::size_t N, class P, class Sampler, class... Visitor>
    requires(sizeof...(Visitor) <= 1)
auto walk(const S& scene, ParametricPhoton<V, F, N, P>&& photon, Sampler& sampler, const WalkLimits& limits,
          Statistics& account, Visitor&&... visitor) {
    constexpr bool is_one_path = !(detail::follows_all_ways<std::remove_reference_t<Visitor>> || ...);
    const detail::ParametricScene<S, P, is_one_path> seen(scene, photon.parameters);
    Photon<V, F, N> walker = detail::plain(photon);
    const auto follow = [&] {
        return walk(seen, std::move(walker), sampler, limits, account, std::forward<Visitor>(visitor)...);
    };
    const auto take_back = [&] {
        photon.position = walker.position;
        photon.direction = walker.direction;
        photon.flux = walker.flux;
        photon.differential = walker.differential;
    };
    if constexpr (std::is_void_v<decltype(follow())>) {
        follow();
        take_back();
    } else {
        auto kept = follow();
        take_back();
        return kept;
    }
}

/// The same, for a photon that the walk copies and does not change.
template <class S, Vector3 V, Flux F, std::size_t N, class P, class Sampler, class... Visitor>
    requires(sizeof...(Visitor) <= 1)
auto walk(const S& scene, const ParametricPhoton<V, F, N, P>& photon, Sampler& sampler, const WalkLimits& limits,
          Statistics& account, Visitor&&... visitor) {
    ParametricPhoton<V, F, N, P> walker = photon;
    return walk(scene, std::move(walker), sampler, limits, account, std::forward<Visitor>(visitor)...);
}

} // namespace nephroid
