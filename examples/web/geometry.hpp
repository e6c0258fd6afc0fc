// SPDX-License-Identifier: MIT
/// @file  What the scenes of the browser are made of: rays, hits, and the share of light that glass reflects.
#pragma once

#include <nephroid/differential/curvature.hpp>
#include <nephroid/transport/hit.hpp>
#include <nephroid/transport/scattering.hpp>
#include <nephroid/vector/glm.hpp>

#include <glm/geometric.hpp>

#include <cmath>
#include <cstddef>
#include <optional>

namespace nephroid::examples::web {

using Vec = glm::vec3;
using Hit = SurfaceHit<Vec, ShapeOperator<Vec>>;
using Scattered = Scattering<float, float>;

/// Hits count between t_min and t_max.
struct Ray {
    Vec origin, direction;
    float t_min, t_max;

    [[nodiscard]] Vec at(float t) const { return origin + t * direction; }
    [[nodiscard]] bool reaches(float t) const { return t > t_min && t < t_max; }
};

/// A hit's surface in one of the scenes' lists; number 0 is the floor.
inline constexpr std::size_t the_floor = 0;

[[nodiscard]] inline Hit make_hit(const Ray& ray, float t, const Vec& position, const Vec& normal,
                                  const ShapeOperator<Vec>& curvature, std::size_t surface) {
    return {t, position, normal, normal, curvature, rounding_error(ray.origin, t, position), surface};
}

/// The plane z = height, with its normal up or down.
[[nodiscard]] inline Hit plane_hit(const Ray& ray, float t, float height, float up, std::size_t surface) {
    const Vec p = ray.at(t), zero(0);
    return make_hit(ray, t, {p.x, p.y, height}, {0, 0, up}, {zero, zero, zero}, surface);
}

/// The distance to the plane z = height, or nothing.
[[nodiscard]] inline std::optional<float> to_plane(const Ray& ray, float height) {
    const float t = (height - ray.origin.z) / ray.direction.z;
    return ray.reaches(t) ? std::optional(t) : std::nullopt;
}

/// An upright cylinder about the z axis, between two heights.
struct Tube {
    float radius, low, high;

    [[nodiscard]] std::optional<float> nearest(const Ray& ray) const {
        const Vec &o = ray.origin, &d = ray.direction;
        const float dd = d.x * d.x + d.y * d.y, middle = -(o.x * d.x + o.y * d.y) / dd;
        const float x = o.x + middle * d.x, y = o.y + middle * d.y; // where the ray is closest to the axis
        const float half2 = (radius * radius - (x * x + y * y)) / dd;
        if (!(half2 >= 0))
            return std::nullopt;
        const float half = std::sqrt(half2);
        for (const float t : {middle - half, middle + half})
            if (const float z = o.z + t * d.z; ray.reaches(t) && z > low && z < high)
                return t;
        return std::nullopt;
    }

    /// Its normal points away from the axis.
    [[nodiscard]] Hit hit(const Ray& ray, float t, std::size_t surface) const {
        const Vec p = ray.at(t);
        const float inverse = 1 / std::sqrt(p.x * p.x + p.y * p.y);
        const Vec n(inverse * p.x, inverse * p.y, 0), around(-n.y, n.x, 0);
        return make_hit(ray, t, {radius * n.x, radius * n.y, p.z}, n,
                        principal_curvatures(around, 1 / radius, Vec(0, 0, 1), 0), surface);
    }
};

/// The indices of refraction on both sides of a surface.
struct Media {
    float front, back; ///< on the side that its normal points to, and on the other one
};

/// The share of unpolarised light that a smooth surface between two media reflects.
///
/// @param cosine  of the angle of incidence, in [0, 1]
/// @param eta     the index on the ray's side over that on the other one
[[nodiscard]] inline float reflected_share(float cosine, float eta) {
    const float sine2 = eta * eta * (1 - cosine * cosine);
    if (sine2 >= 1)
        return 1;
    const float other = std::sqrt(1 - sine2);
    const float across = (eta * cosine - other) / (eta * cosine + other);
    const float along = (cosine - eta * other) / (cosine + eta * other);
    return 0.5f * (across * across + along * along);
}

/// What passes through a surface. Beyond the critical angle the walk reflects all of it.
[[nodiscard]] inline Scattered pass_through(const Hit& hit, const Vec& direction, const Media& media) {
    const float cosine = -glm::dot(direction, hit.geometric_normal);
    const float eta = cosine > 0 ? media.front / media.back : media.back / media.front;
    const float reflected = reflected_share(std::abs(cosine), eta);
    return Scattered::refract(reflected < 1 ? 1 - reflected : 1, eta);
}

} // namespace nephroid::examples::web
