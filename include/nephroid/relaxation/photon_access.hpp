// SPDX-License-Identifier: MIT
/// @file  How relaxation reads and writes the user's photons.
#pragma once

#include "nephroid/emission/flux.hpp"
#include "nephroid/vector/algebra.hpp"

#include <functional>
#include <ranges>
#include <type_traits>

namespace nephroid {

/// Where a user's photon keeps its position, normal and flux: member pointers, or callables that return references.
template <class Position, class Normal, class Flux>
struct PhotonAccess {
    Position position; ///< to V&: world units, finite; relaxation writes it
    Normal normal;     ///< to V: of the surface, unit; on either side, but alike for all photons of one side
    Flux flux;         ///< to F&: finite; flux diffusion writes it
};

/// Makes an access from its three projections:
///
/// ```cpp
/// nephroid::photon_access(&MyPhoton::position, &MyPhoton::normal, &MyPhoton::flux)
/// ```
template <class Position, class Normal, class Flux>
[[nodiscard]] PhotonAccess<Position, Normal, Flux> photon_access(Position position, Normal normal, Flux flux) {
    return {position, normal, flux};
}

namespace detail {
template <class Photons>
using photon_t = std::ranges::range_reference_t<Photons>;

/// What a projection gives for a photon, reference and all.
template <class Projection, class Photons>
using projected_t = std::invoke_result_t<const Projection&, photon_t<Photons>>;

template <class Photons, class Access>
using position_t = std::remove_cvref_t<projected_t<decltype(Access::position), Photons>>;
template <class Photons, class Access>
using flux_t = std::remove_cvref_t<projected_t<decltype(Access::flux), Photons>>;

/// A projection that refers to a part of the photon which can be written: a value returned would only be a copy.
template <class Projection, class Photons>
concept RefersToPart = std::is_lvalue_reference_v<projected_t<Projection, Photons>> &&
    !std::is_const_v<std::remove_reference_t<projected_t<Projection, Photons>>>;

template <class Access, class Photons>
concept ProjectsPhotons = requires(const Access access, photon_t<Photons> photon) {
    std::invoke(access.position, photon);
    std::invoke(access.normal, photon);
    std::invoke(access.flux, photon);
};

template <class Access, class Photons>
concept GivesNormals = requires(const Access access, photon_t<Photons> photon) {
    { std::invoke(access.normal, photon) } -> std::convertible_to<position_t<Photons, Access>>;
};
} // namespace detail

/// Positions, normals and fluxes can be read from the photons of a range.
template <class Access, class Photons>
concept ReadsPhotons = std::ranges::random_access_range<Photons> && detail::ProjectsPhotons<Access, Photons> &&
    Vector3<detail::position_t<Photons, Access>> && detail::GivesNormals<Access, Photons> &&
    Flux<detail::flux_t<Photons, Access>> &&
    ScalesFlux<detail::flux_t<Photons, Access>, scalar_t<detail::position_t<Photons, Access>>>;

/// Besides, positions and fluxes can be written: their projections return references to what is not const.
template <class Access, class Photons>
concept MovesPhotons = ReadsPhotons<Access, Photons> && detail::RefersToPart<decltype(Access::position), Photons> &&
    detail::RefersToPart<decltype(Access::flux), Photons>;

namespace detail {
template <class Access, class Photons>
consteval bool explain_reading() {
    if constexpr (!std::ranges::random_access_range<Photons>) {
        static_assert(std::ranges::random_access_range<Photons>,
                      "nephroid: the photons are no random-access range (std::vector, std::span, …; not std::list)");
    } else if constexpr (!ProjectsPhotons<Access, Photons>) {
        static_assert(ProjectsPhotons<Access, Photons>,
                      "nephroid: the access's position, normal or flux cannot be called with one of these photons "
                      "(relaxation/photon_access.hpp)");
    } else if constexpr (MustBeFluxFor<flux_t<Photons, Access>, position_t<Photons, Access>>) {
        static_assert(GivesNormals<Access, Photons>,
                      "nephroid: the access's normal does not give the vector that its position gives");
    }
    return false;
}

template <class Access, class Photons>
concept MustReadPhotons = ReadsPhotons<Access, Photons> || explain_reading<Access, Photons>();

template <class Access, class Photons>
consteval bool explain_moving() {
    if constexpr (!std::ranges::random_access_range<Photons>) {
        return explain_reading<Access, Photons>();
    } else if constexpr (std::is_const_v<std::remove_reference_t<photon_t<Photons>>>) {
        static_assert(!std::is_const_v<std::remove_reference_t<photon_t<Photons>>>,
                      "nephroid: the photons are const, and relaxation writes their positions");
    } else if constexpr (MustReadPhotons<Access, Photons>) {
        static_assert(RefersToPart<decltype(Access::position), Photons>,
                      "nephroid: the access's position must return a reference to the photon's position that is not "
                      "const: moving a copy would change nothing");
        static_assert(RefersToPart<decltype(Access::flux), Photons>,
                      "nephroid: the access's flux must return a reference to the photon's flux that is not const");
    }
    return false;
}

/// For functions that move photons: photons that can be moved, or an error that says why not.
template <class Access, class Photons>
concept MustMovePhotons = MovesPhotons<Access, Photons> || explain_moving<Access, Photons>();
} // namespace detail

} // namespace nephroid
