// SPDX-License-Identifier: MIT
/// @file  The policies of photon rays, chosen at compile time: a preset, or one policy at a time by its name.
///
/// ```cpp
/// const auto policies = nephroid::Rays{}.with_ends(nephroid::EndAtPlaneOrBall{}).with_visibility(
///     nephroid::ShortRays{});
/// ```
#pragma once

#include "nephroid/footprint/kernel.hpp"
#include "nephroid/ray/flight_ends.hpp"
#include "nephroid/ray/ray_width.hpp"
#include "nephroid/splat/splat_policies.hpp"

namespace nephroid {

/// No further rays: a flight's light goes as far as its ends say.
struct NoShortRays {};

/// Before a vertex receives, a ray from it against the flight asks whether a surface stands within about the beam's
/// width: then the light that the flight stands for did not come by. Exact behind walls and under plates, and dear: one
/// ray for each vertex that a beam reaches.
struct ShortRays {
    double radii = 2; ///< length of the rays, in radii of the beam over the cosine at the vertex, > 0
};

/// Which flights count: `flights.counts(flight)`. All of them: the whole light.
struct AllFlights {
    static constexpr bool after_bounces = true; ///< whether a flight may count that has left a diffuse surface
    template <class Flight>
    [[nodiscard]] constexpr bool counts(const Flight&) const {
        return true;
    }
};
/// Those that have left a diffuse surface.
struct IndirectFlights {
    static constexpr bool after_bounces = true;
    template <class Flight>
    [[nodiscard]] constexpr bool counts(const Flight& flight) const {
        return flight.diffuse_bounces > 0;
    }
};
/// Those that came through mirrors and glass alone.
struct CausticFlights {
    static constexpr bool after_bounces = false;
    template <class Flight>
    [[nodiscard]] constexpr bool counts(const Flight& flight) const {
        return flight.diffuse_bounces == 0 && flight.specular_events > 0;
    }
};

namespace detail {
template <class P>
concept SelectsFlights = std::semiregular<P> && requires {
    { P::after_bounces } -> std::convertible_to<bool>;
};
template <class P>
consteval bool explain_ends() {
    static_assert(FlightEnds<P>,
                  "nephroid: the ends policy must have operator()(const BehindEnd<T>&) const -> bool and "
                  "`static constexpr bool reaches_behind_plane` (ray/flight_ends.hpp)");
    return false;
}
template <class P>
consteval bool explain_flights() {
    static_assert(SelectsFlights<P>, "nephroid: the flights policy must have counts(flight) const -> bool and `static "
                                     "constexpr bool after_bounces` (ray/ray_policies.hpp)");
    return false;
}

template <class K, class Filter, class Ends, class Flights>
concept MustBeRayPolicies = ((std::semiregular<K> && MapsAnyRadius2<K>) || explain_kernel<K>()) &&
                            (FiltersPixels<Filter> || explain_filter<Filter>()) &&
                            (FlightEnds<Ends> || explain_ends<Ends>()) &&
                            (SelectsFlights<Flights> || explain_flights<Flights>());
} // namespace detail

/// How a flight lights vertices. The type of every member is a policy.
template <class K, class Filter, class Width, class Ends, class Border, class Visibility, class Flights>
    requires detail::MustBeRayPolicies<K, Filter, Ends, Flights>
struct RayPolicies {
    K kernel{};              ///< how flux is spread across a beam (footprint/kernel.hpp)
    Filter filter{};         ///< PixelFilter, or NoPixelFilter (splat/splat_policies.hpp)
    Width width{};           ///< DifferentialWidth, FixedRayWidth, FixedRayCone (ray/ray_width.hpp)
    Ends ends{};             ///< EndAtPlane, EndAtPlaneOrBall, EndAtHalfBall (ray/flight_ends.hpp)
    Border border{};         ///< WholeWidth or ClipAtEmitter
    Visibility visibility{}; ///< NoShortRays or ShortRays
    Flights flights{};       ///< AllFlights, IndirectFlights, CausticFlights
    double reach_behind = 8; ///< how far behind its hit a flight may light, in radii of its beam, > 0. Grazing light
                             ///< needs it: of an open plane's light 0.0013 are lost with 8, 0.02 with 2

    template <class Other>
    [[nodiscard]] constexpr auto with_kernel(const Other& other) const {
        return RayPolicies<Other, Filter, Width, Ends, Border, Visibility, Flights>{
            other, filter, width, ends, border, visibility, flights, reach_behind};
    }
    template <class Other>
    [[nodiscard]] constexpr auto with_filter(const Other& other) const {
        return RayPolicies<K, Other, Width, Ends, Border, Visibility, Flights>{
            kernel, other, width, ends, border, visibility, flights, reach_behind};
    }
    template <class Other>
    [[nodiscard]] constexpr auto with_width(const Other& other) const {
        return RayPolicies<K, Filter, Other, Ends, Border, Visibility, Flights>{
            kernel, filter, other, ends, border, visibility, flights, reach_behind};
    }
    template <class Other>
    [[nodiscard]] constexpr auto with_ends(const Other& other) const {
        return RayPolicies<K, Filter, Width, Other, Border, Visibility, Flights>{
            kernel, filter, width, other, border, visibility, flights, reach_behind};
    }
    template <class Other>
    [[nodiscard]] constexpr auto with_border(const Other& other) const {
        return RayPolicies<K, Filter, Width, Ends, Other, Visibility, Flights>{
            kernel, filter, width, ends, other, visibility, flights, reach_behind};
    }
    template <class Other>
    [[nodiscard]] constexpr auto with_visibility(const Other& other) const {
        return RayPolicies<K, Filter, Width, Ends, Border, Other, Flights>{kernel, filter, width,   ends,
                                                                           border, other,  flights, reach_behind};
    }
    template <class Other>
    [[nodiscard]] constexpr auto with_flights(const Other& other) const {
        return RayPolicies<K, Filter, Width, Ends, Border, Visibility, Other>{kernel, filter,     width, ends,
                                                                              border, visibility, other, reach_behind};
    }
};

/// The default: own widths, ends at the tangent plane, no further rays, all light.
using Rays =
    RayPolicies<BiweightKernel, PixelFilter, DifferentialWidth, EndAtPlane, WholeWidth, NoShortRays, AllFlights>;

namespace detail {
template <class P>
inline constexpr bool is_ray_policies = false;
template <class... Each>
inline constexpr bool is_ray_policies<RayPolicies<Each...>> = true;
} // namespace detail

} // namespace nephroid
