// SPDX-License-Identifier: MIT
/// @file  A light as a surface that paths can hit, for paths in the opposite direction of photons.
#pragma once

#include "common/ray.hpp"

#include "nephroid/emission/flux.hpp"

#include <optional>
#include <vector>

namespace nephroid::examples {

/// A disk or a sphere of constant radiance. Like the library's lights, it does not block rays. The disk emits on the
/// side of its normal, the sphere outwards.
template <class T, Flux F>
struct Emitter {
    Vec3<T> centre;
    Vec3<T> normal; ///< unit; zero for a sphere
    T radius;
    F radiance; ///< flux per area and steradian

    [[nodiscard]] static Emitter disk(const Vec3<T>& centre, const Vec3<T>& normal, T radius, const F& radiance) {
        return {centre, normalize(normal), radius, radiance};
    }
    [[nodiscard]] static Emitter sphere(const Vec3<T>& centre, T radius, const F& radiance) {
        return {centre, Vec3<T>(0), radius, radiance};
    }

    /// The distance at which a ray meets the side that emits, between its t_min and t_max; nothing if it does not.
    ///
    /// @param ray  of unit direction
    [[nodiscard]] std::optional<T> distance(const Ray<T>& ray) const {
        const Vec3<T> to_centre = centre - ray.origin;
        const std::optional<T> t =
            normal == Vec3<T>(0) ? on_sphere(ray.direction, to_centre) : on_disk(ray.direction, to_centre);
        return t && *t > ray.t_min && *t < ray.t_max ? t : std::nullopt;
    }

private:
    [[nodiscard]] std::optional<T> on_disk(const Vec3<T>& direction, const Vec3<T>& to_centre) const {
        const T cosine = dot(direction, normal);
        if (!(cosine < T(0)))
            return std::nullopt;
        const T t = dot(to_centre, normal) / cosine;
        return length2(Vec3<T>(t * direction - to_centre)) <= square(radius) ? std::optional<T>(t) : std::nullopt;
    }

    /// The distance at which a ray enters the sphere; a ray from inside meets only the dark side.
    [[nodiscard]] std::optional<T> on_sphere(const Vec3<T>& direction, const Vec3<T>& to_centre) const {
        const T middle = dot(to_centre, direction);
        const T half_chord2 = square(radius) - length2(Vec3<T>(middle * direction - to_centre));
        return half_chord2 >= T(0) ? std::optional<T>(middle - sqrt(half_chord2)) : std::nullopt;
    }
};

template <class T, Flux F>
using Emitters = std::vector<Emitter<T, F>>;

} // namespace nephroid::examples
