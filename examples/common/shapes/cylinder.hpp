// SPDX-License-Identifier: MIT
/// @file  A part of an upright cylinder: a tube, or a bent screen.
#pragma once

#include "common/ray.hpp"

#include <optional>

namespace nephroid::examples {

/// The points of a cylinder about an upright axis with z in a range and the direction from the axis within an angle of
/// another one. Open at both ends. Its normal points outwards.
template <class T>
class Cylinder {
    using wide = wide_t<T>;
    using WideVec3 = Vec3<wide>;

public:
    struct Options {
        Vec3<T> base{0};              ///< the axis runs upwards from here
        T radius = 1;                 ///< world units, > 0
        T height = 1;                 ///< world units, > 0
        T facing_x = 1, facing_y = 0; ///< the middle of the part, seen from the axis; unit
        T least_cosine = -2;          ///< of the angle to the middle; 0 is a half cylinder, -1 and less a full one
    };

    explicit Cylinder(const Options& options) : o_(options) {}

    [[nodiscard]] Box<T> bounds() const {
        const T r = o_.radius;
        return Box<T>{o_.base - Vec3<T>(r, r, 0), o_.base + Vec3<T>(r, r, o_.height)}.padded();
    }

    [[nodiscard]] std::optional<Candidate<T>> nearest(const Ray<T>& ray, wide t_max) const {
        const WideVec3 o = widen(ray.origin) - widen(o_.base), d = widen(ray.direction);
        const wide dd = d.x * d.x + d.y * d.y;
        if (!(dd > 0))
            return std::nullopt;
        const wide middle = -(o.x * d.x + o.y * d.y) / dd;
        const wide closest2 = square(o.x + middle * d.x) + square(o.y + middle * d.y);
        const wide half_chord2 = (square(wide(o_.radius)) - closest2) / dd;
        if (!(half_chord2 >= 0))
            return std::nullopt;
        const wide half_chord = sqrt(half_chord2);
        for (const wide& t : {middle - half_chord, middle + half_chord})
            if (t > ray.t_min && t < t_max && is_part(o + t * d))
                return Candidate<T>{t};
        return std::nullopt;
    }

    [[nodiscard]] Hit<T> hit(const Ray<T>& ray, const Candidate<T>& candidate) const {
        const WideVec3 p = widen(ray.origin) + candidate.distance * widen(ray.direction) - widen(o_.base);
        const WideVec3 n = normalize(WideVec3(p.x, p.y, 0));
        const WideVec3 on = widen(o_.base) + WideVec3(wide(o_.radius) * n.x, wide(o_.radius) * n.y, p.z);
        const WideVec3 around(-n.y, n.x, 0);
        const wide k = 1 / wide(o_.radius); // around the axis; none along it
        return make_hit<T>(candidate.distance, on, n,
                           make_shape_operator<T>(k * around.x * around, k * around.y * around, WideVec3(0)),
                           magnitude(o_.base) + wide(o_.radius) + wide(o_.height));
    }

private:
    /// @param p  on the cylinder, relative to the base
    [[nodiscard]] bool is_part(const WideVec3& p) const {
        return p.z >= 0 && p.z <= wide(o_.height) &&
               p.x * wide(o_.facing_x) + p.y * wide(o_.facing_y) >= wide(o_.least_cosine) * wide(o_.radius);
    }

    Options o_;
};

} // namespace nephroid::examples
