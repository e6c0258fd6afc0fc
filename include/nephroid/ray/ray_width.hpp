// SPDX-License-Identifier: MIT
/// @file  How wide the beam of a flight is: policies of photon rays.
#pragma once

#include "nephroid/footprint/beam.hpp"
#include "nephroid/transport/flight.hpp"

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <optional>

namespace nephroid {

/// A policy: `width(flight, filter_radius)` returns the beam of a flight, whose tangents are those of the pass's
/// smoothing; nothing if the flight has none that it needs.
///
/// ```cpp
/// struct TwiceAsWide { // as the flight is long
///     template <nephroid::Vector3 V, class F, std::size_t N>
///     auto operator()(const nephroid::Flight<V, F, N>& flight, nephroid::scalar_t<V>) const {
///         return std::optional(nephroid::cone_beam(flight.origin, flight.direction, 0.01f, 0.1f));
///     }
/// };
/// ```
template <class P, class Flight, class V>
concept ChoosesRayWidth = requires(const P width, const Flight& flight, scalar_t<V> filter_radius) {
    { width(flight, filter_radius) } -> std::convertible_to<std::optional<Beam<V>>>;
};

/// The photon's own tangents, as they start at the lamp or at a diffuse surface and go through mirrors and glass. The
/// default. Behind a diffuse surface a beam starts with a width of a few vertices and grows with the density of the
/// surface's directions, as r0 + s t / sqrt(π N p).
struct DifferentialWidth {
    double start_spacings = 3; ///< r0 in median spacings of the receiver's vertices, > 0
    double start = 0;          ///< r0 in world units; 0 to follow from the spacings

    static constexpr double least_cosine = 0.1; ///< at the surface: nearly parallel to it few photons leave, and beams
                                                ///< would have no bound
    static constexpr bool uses_smoothing = true;

    template <Vector3 V, Flux F, std::size_t N>
    [[nodiscard]] std::optional<Beam<V>> operator()(const Flight<V, F, N>& flight, scalar_t<V> filter_radius) const {
        if constexpr (N < 2) {
            return std::nullopt;
        } else {
            for (std::size_t i = 0; i < 2; ++i)
                if (!all_finite(flight.tangents[i].d_position) || !all_finite(flight.tangents[i].d_direction))
                    return std::nullopt;
            return beam_of(flight.origin, flight.direction, flight.tangents, scalar_t<V>(1), filter_radius);
        }
    }
};

/// One radius for all.
struct FixedRayWidth {
    double radius; ///< world units, > 0

    static constexpr bool uses_smoothing = false;

    template <Vector3 V, Flux F, std::size_t N>
    [[nodiscard]] std::optional<Beam<V>> operator()(const Flight<V, F, N>& flight, scalar_t<V>) const {
        using T = scalar_t<V>;
        return cone_beam(flight.origin, flight.direction, T(radius), T(0));
    }
};

/// A cone for all, r0 + r1 t from the start of each flight.
struct FixedRayCone {
    double start;  ///< r0, world units, >= 0
    double growth; ///< r1, >= 0

    static constexpr bool uses_smoothing = false;

    template <Vector3 V, Flux F, std::size_t N>
    [[nodiscard]] std::optional<Beam<V>> operator()(const Flight<V, F, N>& flight, scalar_t<V>) const {
        using T = scalar_t<V>;
        return cone_beam(flight.origin, flight.direction, T(start), T(growth));
    }
};

namespace detail {
/// Whether a width policy follows the pass's smoothing.
template <class Width>
inline constexpr bool uses_smoothing = [] {
    if constexpr (requires { Width::uses_smoothing; })
        return bool(Width::uses_smoothing);
    else
        return true;
}();
} // namespace detail

} // namespace nephroid
