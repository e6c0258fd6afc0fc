// SPDX-License-Identifier: MIT
/// @file  A sphere.
#pragma once

#include "common/ray.hpp"

#include <optional>

namespace nephroid::examples {

template <class T>
class Sphere {
    using wide = wide_t<T>;
    using WideVec3 = Vec3<wide>;

public:
    /// @param radius  world units, > 0
    Sphere(const Vec3<T>& centre, T radius) : centre_(centre), radius_(radius) {}

    [[nodiscard]] Box<T> bounds() const {
        return Box<T>{centre_ - Vec3<T>(radius_), centre_ + Vec3<T>(radius_)}.padded();
    }

    /// The discriminant is taken from the ray's distance to the centre, which does not cancel.
    /// Source: Haines et al. 2019, "Precision Improvements for Ray/Sphere Intersection".
    [[nodiscard]] std::optional<Candidate<T>> nearest(const Ray<T>& ray, wide t_max) const {
        const WideVec3 from_centre = widen(ray.origin) - widen(centre_), d = widen(ray.direction);
        const wide dd = length2(d), middle = -dot(from_centre, d) / dd;
        const WideVec3 closest = from_centre + middle * d;
        const wide half_chord2 = (square(wide(radius_)) - length2(closest)) / dd;
        if (!(half_chord2 >= 0))
            return std::nullopt;
        const wide half_chord = sqrt(half_chord2);
        for (const wide& t : {middle - half_chord, middle + half_chord})
            if (t > ray.t_min && t < t_max)
                return Candidate<T>{t};
        return std::nullopt;
    }

    [[nodiscard]] Hit<T> hit(const Ray<T>& ray, const Candidate<T>& candidate) const {
        const WideVec3 from_centre = widen(ray.origin) + candidate.distance * widen(ray.direction) - widen(centre_);
        const WideVec3 n = normalize(from_centre);
        const wide k = 1 / wide(radius_); // dn = dx / R in the tangent plane
        const auto column = [&](int axis) {
            WideVec3 e(0);
            e[axis] = 1;
            return k * (e - n[axis] * n);
        };
        return make_hit<T>(candidate.distance, widen(centre_) + wide(radius_) * n, n,
                           make_shape_operator<T>(column(0), column(1), column(2)), magnitude(centre_) + wide(radius_));
    }

private:
    Vec3<T> centre_;
    T radius_;
};

} // namespace nephroid::examples
