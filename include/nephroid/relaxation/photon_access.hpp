// SPDX-License-Identifier: MIT
/// @file  How relaxation reads and writes the user's photons.
#pragma once

#include "nephroid/emission/flux.hpp"
#include "nephroid/vector/algebra.hpp"

#include <cstddef>
#include <functional>
#include <ranges>
#include <type_traits>

namespace nephroid {

/// Where a user's photon keeps its position, normal and flux: member pointers, or callables that return references.
template <class Position, class Normal, class Flux>
struct PhotonAccess {
    Position position; ///< to V&: world units, finite; is written
    Normal normal;     ///< to V: the surface's, unit; on either side, but alike for all photons of one side
    Flux flux;         ///< to F&; is written by flux diffusion only
};

/// An access from its three projections:
///
/// ```cpp
/// nephroid::photon_access(&MyPhoton::position, &MyPhoton::normal, &MyPhoton::flux)
/// ```
template <class Position, class Normal, class Flux>
[[nodiscard]] PhotonAccess<Position, Normal, Flux> photon_access(Position position, Normal normal, Flux flux) {
    return {position, normal, flux};
}

namespace detail {
template <class Photons, class Access>
using position_t = std::remove_cvref_t<
    std::invoke_result_t<const decltype(Access::position)&, std::ranges::range_reference_t<Photons>>>;
template <class Photons, class Access>
using flux_t =
    std::remove_cvref_t<std::invoke_result_t<const decltype(Access::flux)&, std::ranges::range_reference_t<Photons>>>;

template <class Photons>
[[nodiscard]] decltype(auto) photon_at(Photons& photons, std::size_t i) {
    return std::ranges::begin(photons)[std::ranges::range_difference_t<Photons>(i)];
}
} // namespace detail

/// What the projections of an access give for photons of this range.
template <class Access, class Photons>
concept ReadsPhotons = std::ranges::random_access_range<Photons> && Vector3<detail::position_t<Photons, Access>> &&
    Flux<detail::flux_t<Photons, Access>> &&
    ScalesFlux<detail::flux_t<Photons, Access>, scalar_t<detail::position_t<Photons, Access>>> &&
    requires(const Access access, std::ranges::range_reference_t<Photons> photon) {
    { std::invoke(access.normal, photon) } -> std::convertible_to<detail::position_t<Photons, Access>>;
};

/// Besides, positions and fluxes can be assigned to.
template <class Access, class Photons>
concept MovesPhotons = ReadsPhotons<Access, Photons> &&
    requires(const Access access, std::ranges::range_reference_t<Photons> photon,
             const detail::position_t<Photons, Access> position, const detail::flux_t<Photons, Access> flux) {
    std::invoke(access.position, photon) = position;
    std::invoke(access.flux, photon) = flux;
};

} // namespace nephroid
