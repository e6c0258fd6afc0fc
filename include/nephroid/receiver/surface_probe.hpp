// SPDX-License-Identifier: MIT
/// @file  How far a surface goes on from a place, along a direction in its tangent plane: until a wall stands there or
///        the surface ends. Found by short rays through the renderer's tracer.
#pragma once

#include "nephroid/transport/ray_start.hpp"
#include "nephroid/transport/turn.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>

namespace nephroid::detail {

/// Surfaces whose normals differ by less than this angle's cosine (60°) count as one, which bends.
inline constexpr double one_surface_cosine = 0.5;

/// Probes a scene's surfaces.
///
/// A ray begins a little above the place and flies along the surface. What it hits ends the surface if its normal is
/// turned by more than 60°; otherwise it is the surface, curved, and the next ray goes on from there. Where nothing
/// stands in the way, rays downwards at 1/8, 1/4, 1/2 and all of the way tell whether there is still surface below, so
/// that gaps narrower than half of their distance may be overlooked. Before the first place without surface the edge is
/// found by halving, to a 64th of its distance and never beyond it. A surface also ends where it has left the tangent
/// plane by a quarter of the distance, as splats reach no further.
template <class S, Vector3 V>
    requires RayTracer<S, V>
class SurfaceProbe {
public:
    using T = scalar_t<V>;
    using H = hit_t<S, V>;

    /// @param scene  kept by reference
    /// @param reach  how far a surface is followed, world units, > 0
    /// @param lift   how far above the surface rays fly, world units, > 0: lower steps are overlooked
    SurfaceProbe(const S& scene, T reach, T lift) : scene_(scene), reach_(reach), least_lift_(lift) {}

    /// The distance from a place up to which the surface goes on; `reach` if it goes on further.
    ///
    /// @param direction  unit, in the tangent plane
    [[nodiscard]] T free_distance(const V& position, const V& normal, const V& direction) {
        const T lift = (std::max)(least_lift_, T(64) * std::numeric_limits<T>::epsilon() * largest_component(position));
        Place at{position, normal};
        V heading = direction;
        T flown(0), risen(0); // up to the place that the surface was followed to
        for (int segment = 0; segment < most_segments && flown < reach_; ++segment) {
            const T rest = reach_ - flown;
            const std::optional<Met> met = trace(at.position + lift * at.normal, heading, rest);
            const bool goes_on = met && is_same_surface(met->normal, normal);
            if (!goes_on) {
                const T end = ground_along(at, heading, lift, met ? met->distance : rest, bool(met), normal);
                return std::clamp(T(flown + end), T(0), reach_);
            }
            const V way = met->position - position;
            const T distance = length(way), rise = abs(dot(way, normal)) / distance;
            if (rise > most_rise) // interpolated, as the ray has left it behind
                return flown + (distance - flown) * (most_rise - risen) / (rise - risen);
            at = {met->position, met->normal};
            flown = distance;
            risen = rise;
            const V along = direction - dot(direction, at.normal) * at.normal;
            heading = normalize(along); // at most 60° from the direction, so never zero
        }
        return reach_;
    }

    /// Rays traced so far.
    [[nodiscard]] std::uint64_t rays() const { return rays_; }

private:
    static constexpr int most_segments = 32;
    static constexpr int most_halvings = 10;
    static constexpr T most_rise = T(0.25); ///< off the tangent plane, over the distance

    struct Place {
        V position, normal;
    };
    struct Met {
        T distance;
        V position;
        V normal; ///< on the ray's side
    };

    [[nodiscard]] static bool is_same_surface(const V& a, const V& b) { return dot(a, b) > T(one_surface_cosine); }

    /// The nearest surface within a distance along a ray.
    [[nodiscard]] std::optional<Met> trace(const V& origin, const V& direction, T distance) {
        ++rays_;
        const T skipped = skipped_by_tracer<V>(scene_);
        const V start = origin - skipped * direction;
        const auto hit = scene_.intersect(start, direction, T(0), distance + skipped);
        if (!hit)
            return std::nullopt;
        const H& there = *hit;
        const T flown = T(there.distance);
        V position = start + flown * direction;
        if constexpr (HasPosition<H, V>)
            position = there.position;
        return Met{(std::max)(T(0), flown - skipped), position,
                   facing_sign(direction, there) * V(there.geometric_normal)};
    }

    /// How far there is surface below a ray that flies along it and meets nothing up to `end`.
    ///
    /// @param stands  whether a wall stands at the end
    [[nodiscard]] T ground_along(const Place& at, const V& heading, T lift, T end, bool stands, const V& normal) {
        if (stands && end <= T(2) * lift)
            return end;
        const auto has_ground = [&](T s) {
            const V above = at.position + (lift * at.normal + s * heading);
            const std::optional<Met> met = trace(above, V(-at.normal), T(2) * lift + most_rise * s);
            return met && is_same_surface(met->normal, normal);
        };
        const T furthest = stands ? end - lift : end;
        T ground = T(0), beyond = furthest / T(8);
        while (has_ground(beyond)) {
            if (beyond == furthest)
                return end;
            ground = beyond;
            beyond = beyond < furthest / T(3) ? T(2) * beyond : furthest;
        }
        for (int i = 0; i < most_halvings && beyond - ground > ground / T(64); ++i) {
            const T between = (ground + beyond) / T(2);
            (has_ground(between) ? ground : beyond) = between;
        }
        return ground; // not between the two: coverage would count what has no surface
    }

    const S& scene_;
    T reach_, least_lift_;
    std::uint64_t rays_ = 0;
};

} // namespace nephroid::detail
