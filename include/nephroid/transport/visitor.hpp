// SPDX-License-Identifier: MIT
/// @file  Visitors: how a method is called during a photon's walk, for flights, surfaces and deposits.
#pragma once

#include "nephroid/emission/photon.hpp"
#include "nephroid/transport/deposit.hpp"
#include "nephroid/transport/flight.hpp"
#include "nephroid/transport/trail.hpp"
#include "nephroid/transport/ways.hpp"

#include <concepts>
#include <cstddef>
#include <optional>
#include <type_traits>

namespace nephroid {

/// A visitor has some of these members. What it does not have is not compiled.
///
/// - `flight(flight)`: called at the start of each flight (transport/flight.hpp), also of those that leave the scene
/// - `meet(hit, from_front, passed)`: called at each reflection and refraction, as soon as it is known whether the
///   photon goes on through the surface, and last at the surface of a deposit; not for Event::absorb and Event::pass
/// - `deposit(deposit, path)`: called for each deposit, with its `WalkedPath`. If it returns void, the photon ends, and
///   the visitor's owner books the flux. If it returns std::optional<Photon<V, F, N>>, that photon goes on from the
///   deposit's position, and the walk books the loss of flux as absorbed; without a photon it is as for void
/// - `using trail = PathSignature`, or a type like it: what the walk remembers of each path. It starts empty at the
///   lamp, is copied where ways part, and comes with each deposit as `path.trail`
/// - `static constexpr bool wants_direct_light = true`: deposits straight from the lamp are visited too; otherwise the
///   walk books them as Fate::direct
/// - `static constexpr bool follows_all_ways = true`: at each surface the photon takes all ways that the scene's
///   `scatter_all` returns, one after the other, in the scene's order, each to its end. There is no roulette then, and
///   a photon may have many deposits, or none
///
/// ```cpp
/// struct Corners { // all deposits of a photon, each with the signature of its path
///     using trail = nephroid::PathSignature;
///     static constexpr bool follows_all_ways = true;
///
///     std::vector<std::pair<std::uint32_t, nephroid::Deposit<Vec3, Colour, 0>>> found;
///
///     void deposit(const nephroid::Deposit<Vec3, Colour, 0>& deposit,
///                  const nephroid::WalkedPath<nephroid::PathSignature>& path) {
///         found.emplace_back(path.trail.value(), deposit);
///     }
/// };
/// ```
///
/// Without `deposit` in the visitor, `walk` returns the deposit, of which there is one at most.
struct NoVisitor {}; ///< has no members

namespace detail {
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

template <class Visitor>
struct trail_of {
    using type = NoTrail;
};
template <class Visitor>
    requires requires { typename Visitor::trail; }
struct trail_of<Visitor> {
    using type = typename Visitor::trail;
};
template <class Visitor>
using trail_t = typename trail_of<Visitor>::type;

template <class Trail, class H>
concept TrailOver = std::default_initializable<Trail> && std::copyable<Trail> && requires(Trail trail, const H& hit) {
    trail.meet(hit, true, true);
};

template <class Visitor>
inline constexpr bool follows_all_ways = [] {
    if constexpr (requires { std::bool_constant<Visitor::follows_all_ways>(); })
        return bool(Visitor::follows_all_ways);
    else
        return false;
}();

template <class Visitor>
inline constexpr bool wants_direct_light = [] {
    if constexpr (requires { std::bool_constant<Visitor::wants_direct_light>(); })
        return bool(Visitor::wants_direct_light);
    else
        return false;
}();

template <class Visitor, class V, class F, std::size_t N>
concept VisitsFlights = requires(Visitor& visitor, const Flight<V, F, N>& flight) {
    visitor.flight(flight);
};

template <class Visitor, class H>
concept VisitsSurfaces = requires(Visitor& visitor, const H& hit) {
    visitor.meet(hit, true, true);
};

template <class Visitor, class V, class F, std::size_t N>
concept VisitsDeposits = requires(Visitor& visitor, const Deposit<V, F, N>& deposit,
                                  const WalkedPath<trail_t<Visitor>>& path) {
    visitor.deposit(deposit, path);
};

/// The visitor may send photons on from deposits.
template <class Visitor, class V, class F, std::size_t N>
concept SendsPhotonsOn = VisitsDeposits<Visitor, V, F, N> &&
    requires(Visitor& visitor, const Deposit<V, F, N>& deposit, const WalkedPath<trail_t<Visitor>>& path) {
    { visitor.deposit(deposit, path) } -> std::convertible_to<std::optional<Photon<V, F, N>>>;
};

template <class Visitor, class V, class F, std::size_t N>
concept EndsPhotonsAtDeposits = VisitsDeposits<Visitor, V, F, N> &&
    requires(Visitor& visitor, const Deposit<V, F, N>& deposit, const WalkedPath<trail_t<Visitor>>& path) {
    { visitor.deposit(deposit, path) } -> std::same_as<void>;
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
    constexpr bool ways_fit = !follows_all_ways<Visitor> || (deposits && ScattersDeterministically<S, V>);
    return has_any && flight_fits && meet_fits && deposit_fits && result_fits && ways_fit &&
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
} // namespace detail

} // namespace nephroid
