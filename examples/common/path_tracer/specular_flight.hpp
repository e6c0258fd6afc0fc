// SPDX-License-Identifier: MIT
/// @file  A flight from one diffuse surface to the next, through mirrors and glass that may touch or lie in each other.
#pragma once

#include "common/scene.hpp"

#include "nephroid/differential/reflection.hpp"
#include "nephroid/differential/refraction.hpp"

#include <algorithm>
#include <limits>
#include <optional>

namespace nephroid::examples {

/// A path that is followed in the opposite direction of photons.
template <class T, Flux F>
struct FlyingPath {
    Vec3<T> origin, direction; ///< the latter unit
    Medium medium{};
    Contacts<T> contacts{};  ///< of the surfaces that it leaves
    std::size_t left = 0;    ///< the material of the last of them
    F radiance = grey<F>(1); ///< seen at the start, over that at the end
    unsigned specular = 0;   ///< surfaces that reflected or refracted it
    bool passed = false;     ///< whether it went through surfaces that light does not notice

    /// Whether a ray to a lamp, which every surface blocks, finds the same light.
    [[nodiscard]] bool is_straight() const { return specular == 0 && !passed; }

    /// Goes on from a hit.
    void leave(const Hit<T>& hit, const Vec3<T>& onwards) {
        const T arrives = dot(direction, hit.geometric_normal), goes = dot(onwards, hit.geometric_normal);
        contacts.leave(hit.primitive, goes, T(2) * hit.position_error, (arrives > T(0)) == (goes > T(0)),
                       contacts.is_here(hit.distance, arrives));
        origin = hit.position;
        direction = onwards;
        left = hit.surface;
    }
};

template <class T, Flux F>
class SpecularFlight {
public:
    /// The scene is kept by reference, and must outlive this object.
    /// @param specular_events  reflections and refractions after which a path that meets one more ends
    SpecularFlight(const Scene<T, F>& scene, unsigned specular_events)
        : scene_(scene), specular_events_(specular_events) {}

    /// Follows a path to the next diffuse surface, and calls see(path, hit) at each surface and once for a path that
    /// leaves the scene, then without a hit.
    ///
    /// @return  the diffuse surface; nothing for a path that ended otherwise
    template <class Sampler, class See>
    [[nodiscard]] std::optional<Hit<T>> operator()(FlyingPath<T, F>& path, Sampler& sampler, const See& see) const {
        for (unsigned unnoticed = 0; unnoticed < most_unnoticed;) {
            const auto hit = scene_.intersect(path.origin, path.direction, path.contacts.t_min(),
                                              std::numeric_limits<T>::infinity(), path.contacts);
            if (hit && is_on_edge(path, *hit)) {
                path.contacts.leave_beside(hit->primitive);
                ++unnoticed;
                continue;
            }
            if (hit) // rounding makes the distance negative where surfaces touch
                path.radiance = path.radiance * scene_.transmittance(path.medium, (std::max)(T(hit->distance), T(0)));
            see(path, hit);
            if (!hit)
                return std::nullopt;
            const Bounce<T, F> bounce = scene_.scatter(*hit, path.direction, sampler, path.medium);
            if (bounce.event == Event::diffuse)
                return hit;
            if (bounce.event == Event::absorb)
                return std::nullopt;
            if (bounce.event == Event::pass) {
                path.passed = true;
                path.medium = bounce.medium;
                path.leave(*hit, path.direction);
                ++unnoticed;
            } else if (!turn(path, *hit, bounce)) {
                return std::nullopt;
            }
        }
        return std::nullopt;
    }

private:
    static constexpr unsigned most_unnoticed = 1000; ///< bounds a tracer that finds the same surface again and again

    /// Whether the hit is on a neighbouring triangle of the surface that was left, at the common edge.
    [[nodiscard]] static bool is_on_edge(const FlyingPath<T, F>& path, const Hit<T>& hit) {
        const T slope = dot(path.direction, hit.geometric_normal);
        return path.contacts.is_here(hit.distance, slope) && hit.surface == path.left &&
               (slope > T(0)) == path.contacts.leaves_along_normal();
    }

    /// Reflects or refracts a path. Radiance changes by (n₁/n₂)² where a path goes from n₁ to n₂,
    /// as refraction changes the solid angle of the light.
    ///
    /// @return  whether it goes on; not if a shading normal sends it to the wrong side
    [[nodiscard]] bool turn(FlyingPath<T, F>& path, const Hit<T>& hit, const Bounce<T, F>& bounce) const {
        if (path.specular++ == specular_events_)
            return false;
        const T side = dot(path.direction, hit.geometric_normal) > T(0) ? T(-1) : T(1);
        const Vec3<T> geometric = side * hit.geometric_normal;
        const Vec3<T> normal =
            dot(path.direction, side * hit.shading_normal) < T(0) ? side * hit.shading_normal : geometric;
        Vec3<T> onwards = path.direction;
        bool goes_through = false;
        if (bounce.event == Event::refract && bounce.eta == T(1)) { // past what does not cover, or through a window
            goes_through = true;
        } else if (bounce.event == Event::refract) {
            if (const auto refracted = refraction(path.direction, normal, bounce.eta)) {
                onwards = refracted->direction();
                goes_through = true;
                path.radiance = path.radiance * grey<F>(double(square(bounce.eta)));
            }
        }
        if (goes_through)
            path.medium = bounce.medium;
        else
            onwards = Reflection<Vec3<T>>(path.direction, normal).direction();
        if ((dot(onwards, geometric) < T(0)) != goes_through)
            return false;
        path.radiance = path.radiance * bounce.weight;
        path.leave(hit, onwards);
        return true;
    }

    const Scene<T, F>& scene_;
    unsigned specular_events_;
};

} // namespace nephroid::examples
