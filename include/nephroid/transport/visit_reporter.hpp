// SPDX-License-Identifier: MIT
/// @file  Reports a photon's walk to a visitor: the flights, surfaces and deposits that the visitor has members for.
#pragma once

#include "nephroid/transport/deposit.hpp"
#include "nephroid/transport/flight.hpp"
#include "nephroid/transport/photon_steps.hpp"
#include "nephroid/transport/trail.hpp"
#include "nephroid/transport/visitor.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <type_traits>

namespace nephroid::detail {

/// Keeps the photon's path, and calls the visitor. What the visitor has no member for is not compiled.
template <class S, Vector3 V, Flux F, std::size_t N, class Visitor>
class VisitReporter {
public:
    using T = scalar_t<V>;
    using H = hit_t<S, V>;
    using Steps = PhotonSteps<S, V, F, N>;
    using Path = WalkedPath<trail_t<Visitor>>;

    /// @param origin  where the photon starts, at the lamp
    VisitReporter(Visitor& visitor, const V& origin) : visitor_(visitor) {
        if constexpr (reports_flights)
            departure_ = {origin, std::nullopt};
    }

    /// The path up to where the photon is.
    [[nodiscard]] Path& path() { return path_; }
    [[nodiscard]] const Path& path() const { return path_; }

    /// The photon flies to a hit, or out of the scene if there is none.
    template <class OptionalHit>
    void flight(const Steps& steps, const OptionalHit& hit) {
        if constexpr (reports_flights) {
            const T distance = hit ? T((*hit).distance) : std::numeric_limits<T>::infinity();
            const std::optional<V> end_normal = hit ? std::optional<V>(steps.facing_normal(*hit)) : std::nullopt;
            // Where surfaces touch, rounding can make the distance negative.
            const T length = (std::max)(steps.ray_start().from_surface(distance), T(0));
            visitor_.flight(departure_.flight(steps.photon(), length, end_normal, path_));
        }
    }

    /// The photon meets a surface.
    void surface(const H& hit, bool from_front, bool passed) {
        path_.trail.meet(hit, from_front, passed);
        if constexpr (VisitsSurfaces<Visitor, H>)
            visitor_.meet(hit, from_front, passed);
    }

    /// Calls the visitor's `deposit`, and returns its result.
    decltype(auto) deposit(const Deposit<V, F, N>& deposit) { return visitor_.deposit(deposit, path_); }

    /// The tangents of a photon that a diffuse surface sends on, if the visitor follows bounces with tangents.
    [[nodiscard]] PhotonDifferential<V, N> reemitted(const V& direction, const T& density) {
        return visitor_.reemitted(direction, density);
    }

    /// The photon is about to leave a surface, with the direction of its next ray.
    void departure(const Steps& steps, const H& hit) {
        if constexpr (reports_flights) // the normal on the side that the photon leaves to
            departure_ = {steps.photon().position, -steps.facing_normal(hit)};
    }

private:
    static constexpr bool reports_flights = VisitsFlights<Visitor, V, F, N>;

    Visitor& visitor_;
    Path path_{};
    [[no_unique_address]] std::conditional_t<reports_flights, Departure<V>, NoDeparture> departure_{};
};

} // namespace nephroid::detail
