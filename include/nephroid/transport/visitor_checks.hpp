// SPDX-License-Identifier: MIT
/// @file  Whether a visitor's members fit the walk; if not, an error says which one does not.
#pragma once

#include "nephroid/transport/visitor.hpp"
#include "nephroid/transport/ways.hpp"

#include <concepts>
#include <cstddef>
#include <type_traits>

namespace nephroid::detail {

struct HasFlight {
    int flight;
};
struct HasMeet {
    int meet;
};
struct HasDeposit {
    int deposit;
};
template <class A, class B>
struct Both : A, B {};

// Whether a type has a member of a name, of any kind: the name is then ambiguous in a class that also inherits another
// member of that name.
template <class Visitor>
concept CanBeBase = std::is_class_v<Visitor> && !std::is_final_v<Visitor>;
template <class Visitor>
concept NamesFlight = CanBeBase<Visitor> && !requires {
    &Both<Visitor, HasFlight>::flight;
};
template <class Visitor>
concept NamesMeet = CanBeBase<Visitor> && !requires {
    &Both<Visitor, HasMeet>::meet;
};
template <class Visitor>
concept NamesDeposit = CanBeBase<Visitor> && !requires {
    &Both<Visitor, HasDeposit>::deposit;
};

template <class Trail, class H>
concept TrailOver = std::default_initializable<Trail> && std::copyable<Trail> && requires(Trail trail, const H& hit) {
    trail.meet(hit, true, true);
};

/// Whether all members that a visitor has can be called as the walk calls them.
template <class Visitor, class S, class V, class F, std::size_t N>
consteval bool fits_walk() {
    using H = hit_t<S, V>;
    constexpr bool flights = VisitsFlights<Visitor, V, F, N>, surfaces = VisitsSurfaces<Visitor, H>,
                   deposits = VisitsDeposits<Visitor, V, F, N>;
    constexpr bool has_any = flights || surfaces || deposits || std::same_as<Visitor, NoVisitor>;
    constexpr bool flight_fits = flights || !NamesFlight<Visitor>;
    constexpr bool meet_fits = surfaces || !NamesMeet<Visitor>;
    constexpr bool deposit_fits = deposits || !NamesDeposit<Visitor>;
    constexpr bool result_fits =
        !deposits || EndsPhotonsAtDeposits<Visitor, V, F, N> || SendsPhotonsOn<Visitor, V, F, N>;
    constexpr bool bounces_fit = !follows_bounces<Visitor> ||
                                 ((N == 0 || StartsTangents<Visitor, V, N>)&&EndsPhotonsAtDeposits<Visitor, V, F, N> &&
                                  !follows_all_ways<Visitor>);
    constexpr bool ways_fit = !follows_all_ways<Visitor> || (deposits && ScattersDeterministically<S, V>);
    return has_any && flight_fits && meet_fits && deposit_fits && result_fits && bounces_fit && ways_fit &&
           TrailOver<trail_t<Visitor>, H>;
}

/// What is wrong with a visitor, as the first line of the compiler's message.
template <class Visitor, class S, class V, class F, std::size_t N>
consteval bool explain_visitor() {
    using H = hit_t<S, V>;
    constexpr bool deposits = VisitsDeposits<Visitor, V, F, N>;
    static_assert(TrailOver<trail_t<Visitor>, H>,
                  "nephroid::walk: the visitor's `trail` must be default-constructible, copyable, and have "
                  "meet(hit, bool from_front, bool passed) (transport/trail.hpp)");
    static_assert(!NamesFlight<Visitor> || VisitsFlights<Visitor, V, F, N>,
                  "nephroid::walk: the visitor's `flight` must take a const Flight<V, F, N>& of the photon's vector, "
                  "flux and number of tangents (transport/flight.hpp)");
    static_assert(!NamesMeet<Visitor> || VisitsSurfaces<Visitor, H>,
                  "nephroid::walk: the visitor's `meet` must take (hit, bool from_front, bool passed) "
                  "(transport/visitor.hpp)");
    static_assert(!NamesDeposit<Visitor> || deposits,
                  "nephroid::walk: the visitor's `deposit` must take (const Deposit<V, F, N>&, const "
                  "WalkedPath<trail>&), of the photon's vector, flux and number of tangents (transport/visitor.hpp)");
    static_assert(!deposits || EndsPhotonsAtDeposits<Visitor, V, F, N> || SendsPhotonsOn<Visitor, V, F, N>,
                  "nephroid::walk: the visitor's `deposit` must return nothing, or std::optional<Photon<V, F, N>>: "
                  "what goes on from there (transport/visitor.hpp)");
    static_assert(
        !follows_bounces<Visitor> || N == 0 || StartsTangents<Visitor, V, N>,
        "nephroid::walk: a visitor that follows bounces walks photons without tangents: emit them from "
        "WithoutTangents(light) (emission/without_tangents.hpp), or give the visitor reemitted(direction, density) "
        "-> PhotonDifferential<V, N> (transport/visitor.hpp)");
    static_assert(!follows_bounces<Visitor> || EndsPhotonsAtDeposits<Visitor, V, F, N>,
                  "nephroid::walk: a visitor that follows bounces must have deposit(deposit, path), which returns "
                  "nothing, as the walk itself sends the photon on (transport/visitor.hpp)");
    static_assert(!follows_bounces<Visitor> || !follows_all_ways<Visitor>,
                  "nephroid::walk: a visitor cannot follow bounces and all ways: diffuse surfaces have too many "
                  "(transport/visitor.hpp)");
    static_assert(!follows_all_ways<Visitor> || deposits,
                  "nephroid::walk: a visitor that follows all ways must have deposit(deposit, path), as a photon then "
                  "has many (transport/visitor.hpp)");
    static_assert(
        !follows_all_ways<Visitor> || ScattersDeterministically<S, V>,
        "nephroid::walk: the visitor follows all ways, but the scene lacks scatter_all(hit, direction) const, "
        "with a third parameter for the medium if scatter has one; if its scatter draws no numbers, say "
        "scatters_by_chance = false (transport/ways.hpp)");
    static_assert(deposits || VisitsFlights<Visitor, V, F, N> || VisitsSurfaces<Visitor, H>,
                  "nephroid::walk: the visitor has neither flight, nor meet, nor deposit (transport/visitor.hpp)");
    return false;
}

template <class Visitor, class S, class V, class F, std::size_t N>
concept MustVisit = fits_walk<Visitor, S, V, F, N>() || explain_visitor<Visitor, S, V, F, N>();

} // namespace nephroid::detail
