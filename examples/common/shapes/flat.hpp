// SPDX-License-Identifier: MIT
/// @file  Flat shapes: a plane (which may repeat itself), a parallelogram, a disk.
#pragma once

#include "common/ray.hpp"

#include "nephroid/vector/frame.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace nephroid::examples {

namespace detail {
/// Where a ray crosses the plane through a point; the normal need not be unit.
template <class T>
[[nodiscard]] std::optional<wide_t<T>> cross_plane(const Ray<T>& ray, const Vec3<wide_t<T>>& point,
                                                   const Vec3<wide_t<T>>& normal, const wide_t<T>& t_max) {
    const wide_t<T> t = dot(point - widen(ray.origin), normal) / dot(widen(ray.direction), normal);
    if (t > ray.t_min && t < t_max)
        return t;
    return std::nullopt;
}
} // namespace detail

/// The unbounded plane z = height. Its normal points up.
///
/// With a period the plane repeats along x and y. The `position` of a hit is wrapped into 0 <= x, y < period, while its
/// `distance` is that along the ray. A look-up near the border then has to search on both sides.
template <class T>
class Floor {
    using wide = wide_t<T>;
    using WideVec3 = Vec3<wide>;

public:
    explicit Floor(T height, T period = 0) : height_(height), period_(period) {}

    [[nodiscard]] Box<T> bounds() const {
        constexpr T everywhere = std::numeric_limits<T>::infinity();
        return {{-everywhere, -everywhere, height_}, {everywhere, everywhere, height_}};
    }

    [[nodiscard]] std::optional<Candidate<T>> nearest(const Ray<T>& ray, wide t_max) const {
        const auto t = detail::cross_plane(ray, WideVec3(0, 0, height_), WideVec3(0, 0, 1), t_max);
        return t ? std::optional(Candidate<T>{*t}) : std::nullopt;
    }

    [[nodiscard]] Hit<T> hit(const Ray<T>& ray, const Candidate<T>& candidate) const {
        const WideVec3 p = widen(ray.origin) + candidate.distance * widen(ray.direction);
        return make_hit<T>(candidate.distance, WideVec3(wrapped(p.x), wrapped(p.y), height_), WideVec3(0, 0, 1), Flat{},
                           abs(wide(height_)));
    }

private:
    [[nodiscard]] wide wrapped(wide x) const {
        const wide period(period_);
        if (!(period > 0))
            return x;
        const T rest = T(x - period * wide(std::floor(double(x / period))));
        return rest < period_ && rest >= T(0) ? wide(rest) : wide(0); // rounding may have moved it to the end
    }

    T height_;
    T period_;
};

/// corner + [0, 1] edge_u + [0, 1] edge_v, edges at any angle. Its normal is along edge_u × edge_v.
template <class T>
class Quad {
    using wide = wide_t<T>;
    using WideVec3 = Vec3<wide>;

public:
    Quad(const Vec3<T>& corner, const Vec3<T>& edge_u, const Vec3<T>& edge_v)
        : corner_(corner), edge_u_(edge_u), edge_v_(edge_v), normal_(normalize(cross(widen(edge_u), widen(edge_v)))) {}

    [[nodiscard]] Box<T> bounds() const {
        Box<T> box;
        for (const Vec3<T>& p : {corner_, corner_ + edge_u_, corner_ + edge_v_, corner_ + edge_u_ + edge_v_})
            box.add(p);
        return box.padded();
    }

    [[nodiscard]] std::optional<Candidate<T>> nearest(const Ray<T>& ray, wide t_max) const {
        const auto t = detail::cross_plane(ray, widen(corner_), normal_, t_max);
        if (!t)
            return std::nullopt;
        const WideVec3 p = widen(ray.origin) + *t * widen(ray.direction) - widen(corner_);
        const WideVec3 u = widen(edge_u_), v = widen(edge_v_), face = cross(u, v);
        const wide a = dot(cross(p, v), face), b = dot(cross(u, p), face), one = length2(face);
        if (!(a >= 0 && a <= one && b >= 0 && b <= one))
            return std::nullopt;
        return Candidate<T>{*t};
    }

    [[nodiscard]] Hit<T> hit(const Ray<T>& ray, const Candidate<T>& candidate) const {
        const WideVec3 p = widen(ray.origin) + candidate.distance * widen(ray.direction);
        return make_hit<T>(candidate.distance, p - dot(p - widen(corner_), normal_) * normal_, normal_, Flat{},
                           magnitude(corner_) + magnitude(edge_u_) + magnitude(edge_v_));
    }

private:
    Vec3<T> corner_, edge_u_, edge_v_;
    WideVec3 normal_;
};

/// A disk of any orientation.
template <class T>
class Disk {
    using wide = wide_t<T>;
    using WideVec3 = Vec3<wide>;

public:
    /// @param normal  any length but zero
    /// @param radius  world units, > 0
    Disk(const Vec3<T>& centre, const Vec3<T>& normal, T radius)
        : centre_(centre), normal_(normalize(widen(normal))), radius_(radius) {}

    [[nodiscard]] Box<T> bounds() const {
        Box<T> box;
        for (int axis = 0; axis < 3; ++axis) {
            const wide reach = wide(radius_) * sqrt((std::max)(wide(0), 1 - square(normal_[axis])));
            box.min[axis] = centre_[axis] - T(reach);
            box.max[axis] = centre_[axis] + T(reach);
        }
        return box.padded();
    }

    [[nodiscard]] std::optional<Candidate<T>> nearest(const Ray<T>& ray, wide t_max) const {
        const auto t = detail::cross_plane(ray, widen(centre_), normal_, t_max);
        if (!t)
            return std::nullopt;
        const WideVec3 p = widen(ray.origin) + *t * widen(ray.direction) - widen(centre_);
        if (!(length2(p) <= square(wide(radius_))))
            return std::nullopt;
        return Candidate<T>{*t};
    }

    [[nodiscard]] Hit<T> hit(const Ray<T>& ray, const Candidate<T>& candidate) const {
        const WideVec3 p = widen(ray.origin) + candidate.distance * widen(ray.direction);
        return make_hit<T>(candidate.distance, p - dot(p - widen(centre_), normal_) * normal_, normal_, Flat{},
                           magnitude(centre_) + wide(radius_));
    }

private:
    Vec3<T> centre_;
    WideVec3 normal_;
    T radius_;
};

} // namespace nephroid::examples
