// SPDX-License-Identifier: MIT
/// @file  A flight: the straight segment of a photon's path from its lamp or a surface to the next surface.
#pragma once

#include "nephroid/emission/photon.hpp"
#include "nephroid/transport/trail.hpp"

#include <cstddef>
#include <limits>
#include <optional>

namespace nephroid {

/// A flight, with the flux and the tangents that the photon carries.
///
/// @tparam N  tangents
template <Vector3 V, Flux F, std::size_t N = 2>
struct Flight {
    using T = scalar_t<V>;

    V origin;                          ///< on the surface that the photon left, or at the lamp
    V direction;                       ///< unit
    T distance;                        ///< to the next surface, world units; infinite where the photon leaves the scene
    F flux;                            ///< at the origin, before a medium absorbs any of it
    PhotonDifferential<V, N> tangents; ///< at the origin
    std::optional<V> origin_normal;    ///< geometric, unit, on the side that the photon left to; nothing at a lamp
    std::optional<V> end_normal;       ///< geometric, unit, on the side that the photon arrives from; nothing where it
                                       ///< leaves the scene
    unsigned specular_events;          ///< reflections and refractions before this flight
    unsigned diffuse_bounces;          ///< diffuse surfaces before it

    [[nodiscard]] bool leaves_scene() const { return !end_normal.has_value(); }
    /// Where it ends; not finite if it leaves the scene.
    [[nodiscard]] V end() const { return origin + distance * direction; }
};

namespace detail {

/// Where a flight begins: on a surface, or at a lamp, which has no normal.
template <Vector3 V>
struct Departure {
    V position;
    std::optional<V> normal;

    /// @param distance    from here, world units
    /// @param end_normal  of the surface that the photon arrives at
    template <Flux F, std::size_t N, class Trail>
    [[nodiscard]] Flight<V, F, N> flight(const Photon<V, F, N>& photon, scalar_t<V> distance,
                                         const std::optional<V>& end_normal, const WalkedPath<Trail>& path) const {
        return {position,    photon.direction,     distance,
                photon.flux, photon.differential,  normal,
                end_normal,  path.specular_events, path.diffuse_bounces};
    }
};
/// In place of Departure, if the visitor does not ask for flights.
struct NoDeparture {};

} // namespace detail

} // namespace nephroid
