// SPDX-License-Identifier: MIT
/// @file  Visitors: how a method is called during a photon's walk, for flights, surfaces and deposits.
#pragma once

#include "nephroid/emission/photon.hpp"
#include "nephroid/transport/deposit.hpp"
#include "nephroid/transport/flight.hpp"
#include "nephroid/transport/scene.hpp"
#include "nephroid/transport/trail.hpp"

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
///   walk books them as Fate::direct, or passes them over if it follows bounces
/// - `static constexpr bool follows_bounces = true`: the photon goes on from diffuse surfaces (Event::diffuse) in a
///   random direction, each as likely as it is bright, and ends there with a probability of 1 − albedo. `deposit` is
///   called at each of them and returns void. The walk books all flux, also what surfaces receive
///   (`Statistics::received`). For photons without tangents (`WithoutTangents`), or with the next member
/// - `reemitted(direction, density)`: returns the tangents, PhotonDifferential<V, N>, of a photon that a diffuse
///   surface sends on in a random direction of this density per steradian. The old ones end there
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

template <class Visitor>
inline constexpr bool follows_all_ways = [] {
    if constexpr (requires { std::bool_constant<Visitor::follows_all_ways>(); })
        return bool(Visitor::follows_all_ways);
    else
        return false;
}();

template <class Visitor>
inline constexpr bool follows_bounces = [] {
    if constexpr (requires { std::bool_constant<Visitor::follows_bounces>(); })
        return bool(Visitor::follows_bounces);
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

template <class Visitor, class V, std::size_t N>
concept StartsTangents = requires(Visitor& visitor, const V& direction, scalar_t<V> density) {
    { visitor.reemitted(direction, density) } -> std::convertible_to<PhotonDifferential<V, N>>;
};

template <class Visitor, class V, class F, std::size_t N>
concept EndsPhotonsAtDeposits = VisitsDeposits<Visitor, V, F, N> &&
    requires(Visitor& visitor, const Deposit<V, F, N>& deposit, const WalkedPath<trail_t<Visitor>>& path) {
    { visitor.deposit(deposit, path) } -> std::same_as<void>;
};

/// The visitor may send photons on from deposits. Void is left out first: libc++ 14 can't ask whether it converts.
template <class Visitor, class V, class F, std::size_t N>
concept SendsPhotonsOn =
    VisitsDeposits<Visitor, V, F, N> && !EndsPhotonsAtDeposits<Visitor, V, F, N> &&
    requires(Visitor & visitor, const Deposit<V, F, N>& deposit, const WalkedPath<trail_t<Visitor>>& path) {
    { visitor.deposit(deposit, path) } -> std::convertible_to<std::optional<Photon<V, F, N>>>;
};
} // namespace detail

} // namespace nephroid
