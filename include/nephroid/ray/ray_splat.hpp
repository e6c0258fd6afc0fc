// SPDX-License-Identifier: MIT
/// @file  A flight prepared for splatting: its beam, its two ends, and the volume in which vertices may receive.
#pragma once

#include "nephroid/ray/ray_policies.hpp"
#include "nephroid/receiver/eye_path_map.hpp"
#include "nephroid/transport/account.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>

namespace nephroid {

/// One flight, ready for the inner loop. All places are relative to the origin of the receiver's tree.
template <Vector3 V, Flux F>
struct RaySplat {
    using T = scalar_t<V>;

    Beam<V> beam;
    F flux;
    V origin_normal;               ///< of the surface that it left; 0 if it left none that matters
    V end, end_normal;             ///< where it met a surface; of unit length
    T distance;                    ///< until that surface; infinite if it leaves the scene
    T end_radius2;                 ///< squared radius of the beam there
    T rounding;                    ///< of heights over planes, world units
    std::array<T, 2> depth;        ///< between which vertices may receive
    std::array<T, 2> outer_radius; ///< of the beam there: it is below the line between them
};

/// The outcome of `make_ray_splat`: a splat, or why there is none.
template <Vector3 V, Flux F>
struct RaySplatOutcome {
    std::optional<RaySplat<V, F>> splat;
    Fate fate = Fate::splatted;
    bool bounded = false; ///< whether the beam was wider than the receiver
};

namespace detail {
/// The normal of a lamp with area where a photon left it, by the plane that its tangents lie in; 0 if it left a point,
/// or a beam without spread, which have no border that is seen.
template <Vector3 V, Flux F, std::size_t N>
[[nodiscard]] V lamp_normal(const Flight<V, F, N>& flight) {
    using T = scalar_t<V>;
    if constexpr (N >= 2) {
        if (flight.specular_events > 0 || flight.diffuse_bounces > 0)
            return zero_vector<V>();
        const V across = cross(flight.tangents[0].d_position, flight.tangents[1].d_position);
        const T turns = (std::max)(largest_component(flight.tangents[0].d_direction),
                                   largest_component(flight.tangents[1].d_direction));
        if (largest_component(across) > T(0) && turns > T(0)) {
            const V normal = direction_of(across);
            return dot(normal, flight.direction) < T(0) ? V(-normal) : normal;
        }
    }
    return zero_vector<V>();
}

/// How far behind its end a beam may light a vertex.
template <class Ends, Scalar T>
[[nodiscard]] T reach_behind(const T& radius, const T& growth, const T& cosine, const T& most) {
    const T sine = sqrt((std::max)(T(0), (T(1) - cosine) * (T(1) + cosine)));
    // A disk's edge at depth s behind the hit is in front of the plane while s cos < (radius + growth s) sin.
    const T slope = cosine - (std::max)(growth, T(0)) * sine;
    const T plane = slope > T(0) ? radius * sine / slope : most;
    return (std::min)(most, Ends::reaches_behind_plane ? (std::max)(plane, radius) : plane);
}
} // namespace detail

/// Makes a splat of a flight, whose tangents are those of the pass's smoothing.
template <Vector3 V, Flux F, std::size_t N, class Policies>
[[nodiscard]] RaySplatOutcome<V, F> make_ray_splat(const Flight<V, F, N>& flight, const EyePathMap<V>& map,
                                                   const Policies& policies) {
    using T = scalar_t<V>;
    using t = vector_traits<V>;
    using Filter = std::remove_cvref_t<decltype(policies.filter)>;
    RaySplatOutcome<V, F> outcome{};
    const auto ended = [&](Fate fate) {
        outcome.fate = fate;
        return outcome;
    };
    const T unit = length2(flight.direction) - T(1);
    if (!all_finite(flight.origin) || !(abs(unit) < T(0.01)) || !(flight.distance > T(0)) ||
        !isfinite(double(flux_traits<F>::power(flight.flux))))
        return ended(Fate::invalid);
    if (map.tree().empty())
        return ended(Fate::unseen);
    T filter(0);
    if constexpr (!std::same_as<Filter, NoPixelFilter>)
        filter = T(pixel_filter_width<std::remove_cvref_t<decltype(policies.kernel)>> * policies.filter.width_scale) *
                 map.spacing_at(flight.leaves_scene() ? flight.origin : flight.end());
    std::optional<Beam<V>> beam = policies.width(flight, filter);
    if (!beam)
        return ended(Fate::invalid);
    beam->origin = map.tree().relative(flight.origin);

    // The depths of the receiver's box, and of the flight.
    const Box<T> box = map.tree().bounds();
    const auto along = [&](T d, T low, T high, bool is_last) { return d * ((d > T(0)) == is_last ? high : low); };
    const auto support = [&](bool is_last) {
        const V& d = beam->direction;
        return along(t::x(d), box.low[0], box.high[0], is_last) + along(t::y(d), box.low[1], box.high[1], is_last) +
               along(t::z(d), box.low[2], box.high[2], is_last) - dot(beam->origin, d);
    };
    const T size = largest_component(beam->origin) + map.diagonal();
    const T rounding = T(16) * std::numeric_limits<T>::epsilon() * size;
    const T first = (std::max)(T(0), support(false) - rounding);
    T last = support(true) + rounding;
    const T distance = flight.leaves_scene() ? std::numeric_limits<T>::infinity() : flight.distance;
    T end_radius(0);
    V end = beam->origin, end_normal = beam->direction;
    if (!flight.leaves_scene()) {
        end = map.tree().relative(flight.end()), end_normal = *flight.end_normal;
        end_radius = beam->largest_radius(distance);
        const T most = T(policies.reach_behind) * end_radius;
        const T growth = (beam->largest_radius(distance + most) - end_radius) / (most > T(0) ? most : T(1));
        last = (std::min)(last, distance + rounding +
                                    detail::reach_behind<std::remove_cvref_t<decltype(policies.ends)>>(
                                        end_radius, growth, abs(dot(end_normal, beam->direction)), most));
    }
    if (!(last > first))
        return ended(Fate::unseen);
    T from = beam->largest_radius(first), to = beam->largest_radius(last);
    const T widest = (std::max)(from, to);
    if (!isfinite(widest))
        return ended(Fate::invalid);
    if (!(widest > T(0)))
        return ended(Fate::collapsed);
    if (widest > map.diagonal() && map.diagonal() > T(0)) {
        outcome.bounded = true;
        const T scale = map.diagonal() / widest;
        for (auto* const pairs : {&beam->start, &beam->growth})
            for (auto& pair : *pairs)
                pair = {scale * pair[0], scale * pair[1]};
        beam->filter2 = scale * scale * beam->filter2;
        from = scale * from, to = scale * to;
        end_radius = (std::min)(end_radius, beam->largest_radius(flight.leaves_scene() ? last : distance));
    }
    const V origin_normal = flight.origin_normal ? *flight.origin_normal : detail::lamp_normal(flight);
    outcome.splat = RaySplat<V, F>{*beam,    flight.flux,        origin_normal, end,           end_normal,
                                   distance, square(end_radius), rounding,      {first, last}, {from, to}};
    return outcome;
}

} // namespace nephroid
