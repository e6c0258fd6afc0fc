// SPDX-License-Identifier: MIT
/// @file  Where a ray begins: on the surface that it leaves or barely off it, and further back by the distance that the
///        tracer skips.
#pragma once

#include "nephroid/transport/contacts.hpp"
#include "nephroid/transport/scene.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace nephroid::detail {

/// How far off a surface the next ray begins, world units: twice the hit's error, once for the hit itself and once for
/// the rounding of the next intersection. The error is taken as at least a few units in the last place of the
/// coordinates, whatever the hit's `position_error` is; the result is NaN if that is negative or NaN.
///
/// @param position  on the surface
template <class H, Vector3 V>
[[nodiscard]] scalar_t<V> ray_clearance(const H& hit, const V& position) {
    using T = scalar_t<V>;
    const T rounding = T(4) * std::numeric_limits<T>::epsilon() * largest_component(position);
    if constexpr (HasPositionError<H, V>)
        return T(hit.position_error) >= T(0) ? T(2) * (std::max)(rounding, T(hit.position_error))
                                             : std::numeric_limits<T>::quiet_NaN();
    else
        return T(4) * rounding;
}

/// What the scene's tracer skips at the start of every ray, world units; NaN if that is negative.
template <Vector3 V, class S>
[[nodiscard]] scalar_t<V> skipped_by_tracer([[maybe_unused]] const S& scene) {
    if constexpr (HasTracerEpsilon<S, V>)
        return scalar_t<V>(scene.tracer_epsilon) >= scalar_t<V>(0) ? scalar_t<V>(scene.tracer_epsilon)
                                                                   : std::numeric_limits<scalar_t<V>>::quiet_NaN();
    else
        return scalar_t<V>(0);
}

/// Where a photon's ray begins: on the surface that it leaves if the scene can leave out surfaces that touch there
/// (Contacts), otherwise a little off that surface.
template <class S, Vector3 V>
class RayStart {
public:
    using T = scalar_t<V>;
    using H = hit_t<S, V>;
    static constexpr bool surfaces_may_touch = LetsSurfacesTouch<S, V>;
    static_assert(!surfaces_may_touch || !HasTracerEpsilon<S, V>,
                  "nephroid: a scene that takes Contacts must have no tracer_epsilon, but find what lies at its rays' "
                  "start (transport/contacts.hpp)");

    /// Begins a ray at the lamp.
    template <class P>
    void begin(const S& scene, P& photon) {
        begin_ahead(scene, photon, T(0));
    }

    template <class P>
    [[nodiscard]] auto next_hit(const S& scene, const P& photon) const {
        constexpr T endless = std::numeric_limits<T>::infinity();
        if constexpr (surfaces_may_touch)
            return scene.intersect(photon.position, photon.direction, contact_.surfaces.t_min(), endless,
                                   contact_.surfaces);
        else
            return scene.intersect(photon.position, photon.direction, T(0), endless);
    }

    /// The distance along the ray to a hit. It is not negative for surfaces that touch the one left, on whichever side
    /// rounding puts them.
    [[nodiscard]] T distance_to(const H& hit, const V& direction) const {
        const T distance = hit.distance;
        if constexpr (surfaces_may_touch)
            if (contact_.surfaces.is_here(distance, dot(direction, V(hit.geometric_normal))))
                return (std::max)(distance, T(0));
        return distance;
    }
    /// The distance from the surface that was left, for a distance along the ray, which began a little ahead.
    [[nodiscard]] T from_surface(T distance) const { return distance + ahead_; }

    /// The ray ends at a hit.
    ///
    /// @param photon  at the hit
    /// @param flown   length of the flight, world units
    template <class P>
    void arrive(const H& hit, const P& photon, T flown) {
        const T cosine = dot(photon.direction, V(hit.geometric_normal));
        if constexpr (surfaces_may_touch)
            if (contact_.begins_on_surface()) {
                began_here_ = contact_.surfaces.is_here(T(hit.distance), cosine);
                return;
            }
        began_here_ = flown * abs(cosine) <= T(2) * ray_clearance(hit, photon.position);
    }
    /// Whether the photon's surface lies where its ray began, to rounding.
    [[nodiscard]] bool began_here() const { return began_here_; }

    /// Begins the next ray.
    ///
    /// @param photon  at the hit, with the direction of the next ray
    /// @param passed  whether it goes on through the surface
    template <class P>
    void leave(const S& scene, const H& hit, [[maybe_unused]] bool passed, P& photon) {
        const V normal = hit.geometric_normal;
        const T cosine = dot(photon.direction, normal), steepness = abs(cosine);
        if constexpr (surfaces_may_touch) {
            contact_.surfaces.leave(hit.primitive, cosine, ray_clearance(hit, photon.position), passed, began_here_);
            if constexpr (requires { hit.surface; })
                contact_.left = std::uint64_t(hit.surface);
            begin_ahead(scene, photon, T(0));
        } else if constexpr (SpawnsRays<S, V>) {
            photon.position = scene.spawn(hit, photon.direction);
            begin_ahead(scene, photon, T(0));
        } else {
            // Along the ray, so that it keeps its line. At low angles that would be far: the rest is along the normal.
            const T height = ray_clearance(hit, photon.position);
            const T along = steepness > T(0.5) ? height / steepness : T(2) * height;
            const T rest = (std::max)(T(0), height - along * steepness);
            photon.position = photon.position + (along * photon.direction + (cosine > T(0) ? rest : -rest) * normal);
            begin_ahead(scene, photon, along + rest * steepness);
        }
    }

    /// Whether the hit is on a neighbouring triangle of the surface that was left. The photon then came through the
    /// edge between the two, and this triangle is left out from now on.
    [[nodiscard]] bool is_on_edge([[maybe_unused]] const H& hit, [[maybe_unused]] const V& direction) {
        if constexpr (surfaces_may_touch && requires { hit.surface; }) {
            const T cosine = dot(direction, V(hit.geometric_normal));
            const bool is_beside = contact_.surfaces.is_here(T(hit.distance), cosine) &&
                                   std::uint64_t(hit.surface) == contact_.left &&
                                   (cosine > T(0)) == contact_.surfaces.leaves_along_normal();
            if (is_beside)
                contact_.surfaces.leave_beside(hit.primitive);
            return is_beside;
        } else {
            return false;
        }
    }

private:
    /// @param ahead  how far the photon was moved from the surface, along its line
    template <class P>
    void begin_ahead(const S& scene, P& photon, T ahead) {
        ahead_ = ahead - skipped_by_tracer<V>(scene);
        if constexpr (HasTracerEpsilon<S, V>)
            photon.position = photon.position - skipped_by_tracer<V>(scene) * photon.direction;
    }

    T ahead_ = T(0); ///< how far the ray began ahead of the surface that the photon left
    bool began_here_ = false;
    [[no_unique_address]] typename contact_of<S, V>::type contact_{};
};

} // namespace nephroid::detail
