// SPDX-License-Identifier: MIT
/// @file  Where a ray begins: on the surface that it leaves, or off it by no more than rounding, and back by what the
///        tracer skips.
#pragma once

#include "nephroid/transport/contacts.hpp"
#include "nephroid/transport/scene.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace nephroid::detail {

/// How far off a surface the next ray begins, world units: twice the error, once for the point that was hit, once for
/// the next intersection's own rounding. Coordinates are never more exact than a few units in their last place,
/// whatever the hit says of its `position_error`; NaN where that is negative or no number.
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

/// What the scene's tracer skips at the start of every ray, world units.
template <Vector3 V, class S>
[[nodiscard]] scalar_t<V> skipped_by_tracer([[maybe_unused]] const S& scene) {
    if constexpr (HasTracerEpsilon<S, V>)
        return scalar_t<V>(scene.tracer_epsilon);
    else
        return scalar_t<V>(0);
}

/// Where a photon's ray begins: on the surface that it leaves if the scene leaves out what touches there (Contacts),
/// else a little off it.
template <class S, Vector3 V>
class RayStart {
public:
    using T = scalar_t<V>;
    using H = hit_t<S, V>;
    static constexpr bool surfaces_may_touch = LetsSurfacesTouch<S, V>;
    static_assert(!surfaces_may_touch || !HasTracerEpsilon<S, V>,
                  "nephroid: a scene that takes Contacts must have no tracer_epsilon, but find what lies at its rays' "
                  "start (transport/contacts.hpp)");

    /// At the lamp.
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

    /// Along the ray. What touches the surface that was left is no distance away, whichever side rounding put it on.
    [[nodiscard]] T distance_to(const H& hit, const V& direction) const {
        const T distance = hit.distance;
        if constexpr (surfaces_may_touch)
            if (contact_.surfaces.is_here(distance, dot(direction, V(hit.geometric_normal))))
                return (std::max)(distance, T(0));
        return distance;
    }
    /// From the surface that was left to a distance along the ray, which began a little ahead.
    [[nodiscard]] T from_surface(T distance) const { return distance + ahead_; }

    /// @param photon  at the hit
    /// @param flown   by it
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
    /// Whether the surface that the photon is at is where its ray began, as far as numbers can tell.
    [[nodiscard]] bool began_here() const { return began_here_; }

    /// @param photon  at the hit, its direction that of the next ray
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
            // Along the ray, which so stays on its line, and only for what is left at low angles along the normal.
            const T height = ray_clearance(hit, photon.position);
            const T along = steepness > T(0.5) ? height / steepness : T(2) * height;
            const T rest = (std::max)(T(0), height - along * steepness);
            photon.position = photon.position + (along * photon.direction + (cosine > T(0) ? rest : -rest) * normal);
            begin_ahead(scene, photon, along + rest * steepness);
        }
    }

    /// Whether the hit is a triangle beside the one that was left, of the same surface: the photon came through their
    /// edge, and the other one is left out from now on.
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
    /// @param ahead  how far along its line from the surface the photon was put
    template <class P>
    void begin_ahead(const S& scene, P& photon, T ahead) {
        ahead_ = ahead - skipped_by_tracer<V>(scene);
        if constexpr (HasTracerEpsilon<S, V>)
            photon.position = photon.position - skipped_by_tracer<V>(scene) * photon.direction;
    }

    T ahead_ = T(0); ///< how far ahead of the surface that the photon left its ray began
    bool began_here_ = false;
    [[no_unique_address]] typename contact_of<S, V>::type contact_{};
};

} // namespace nephroid::detail
