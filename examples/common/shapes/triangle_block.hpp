// SPDX-License-Identifier: MIT
/// @file  Four triangles of a mesh that are tested against a ray at once.
#pragma once

#include "common/registers.hpp"
#include "common/shapes/mesh_data.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <span>

namespace nephroid::examples {

/// The triangles of a leaf, in structure-of-arrays order. `filter` tests all of them in T, with a bound on its
/// rounding, and keeps those that the ray may hit. `decide` tests one of these in `wide`, with a bound on that
/// rounding. So no ray passes between triangles that share an edge, and a hit is as exact as its vertices.
template <class T>
class alignas(16) TriangleBlock {
    using wide = wide_t<T>;
    using WideVec3 = Vec3<wide>;

public:
    static constexpr std::size_t lanes = 4;

    /// @param triangles  their indices, 1 to `lanes` of them; vacant lanes repeat the first
    TriangleBlock(const MeshData<T>& data, std::span<const std::uint32_t> triangles) {
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            const std::uint32_t triangle = triangles[lane < triangles.size() ? lane : 0];
            const auto points = data.corners(triangle);
            triangles_[lane] = triangle;
            for (std::size_t i = 0; i < 3; ++i) {
                for (std::size_t axis = 0; axis < 3; ++axis)
                    vertices_[i][axis][lane] = points[i][int(axis)];
                longest_ = (std::max)(longest_, T(magnitude(points[(i + 1) % 3] - points[i])));
            }
        }
    }

    /// The triangles that the ray may hit, as bits.
    [[nodiscard]] unsigned filter(const Ray<T>& ray, T t_max) const {
        decltype(Lanes{} < Lanes{}) missed{};
        for (std::size_t first = 0; first < lanes; first += RegisterOf<T>::lanes)
            missed |= bits_from(first, misses(first, ray, t_max));
        return ~all_bits(missed) & ((1u << lanes) - 1);
    }

    /// Plücker's test in `wide`, in which triangles that share an edge get the same result for it, and the position of
    /// the hit. A triangle that is parallel to the ray is not hit, but its neighbours are.
    /// Source: Davis et al. 2012 as in Embree; the bounds are ours.
    [[nodiscard]] std::optional<Candidate<T>> decide(std::size_t lane, const Ray<T>& ray, wide t_max) const {
        const WideVec3 o = widen(ray.origin), d = widen(ray.direction);
        const auto vertex = [&](std::size_t i) {
            const auto& v = vertices_[i];
            return WideVec3(v[0][lane], v[1][lane], v[2][lane]) - o;
        };
        const WideVec3 a = vertex(0), b = vertex(1), c = vertex(2);
        const wide bound =
            8 * std::numeric_limits<wide>::epsilon() * wide(longest_) * (magnitude(a) + wide(longest_)) * magnitude(d);
        const wide u = glm::dot(glm::cross(c - a, c + a), d);
        const wide v = glm::dot(glm::cross(a - b, a + b), d);
        const wide w = glm::dot(glm::cross(b - c, b + c), d);
        const wide least = (std::min)({u, v, w}), most = (std::max)({u, v, w});
        if ((least < -bound && most > bound) || (least >= -bound && most <= bound))
            return std::nullopt;
        const WideVec3 normal = glm::cross(b - a, c - a);
        const wide t = glm::dot(normal, a) / glm::dot(normal, d);
        if (!(t > wide(ray.t_min) && t < t_max))
            return std::nullopt;
        // A point that is outside by rounding is moved onto the edge.
        const wide sign = most > bound ? 1 : -1;
        const wide inner_u = (std::max)(0.0, sign * u), inner_v = (std::max)(0.0, sign * v);
        const wide sum = inner_u + inner_v + (std::max)(0.0, sign * w);
        return Candidate<T>{t, inner_u / sum, inner_v / sum, triangles_[lane]};
    }

private:
    using Lanes = typename RegisterOf<T>::type;

    /// Vectors, one for each lane of a register.
    struct Vectors {
        Lanes x, y, z;

        [[nodiscard]] Vectors minus(const Vectors& v) const { return {x - v.x, y - v.y, z - v.z}; }
        [[nodiscard]] Lanes dot(const Vectors& v) const { return x * v.x + y * v.y + z * v.z; }
        [[nodiscard]] Vectors cross(const Vectors& v) const {
            return {y * v.z - z * v.y, z * v.x - x * v.z, x * v.y - y * v.x};
        }
    };
    static Lanes absolute(const Lanes& a) { return most(a, -a); }
    static Lanes least(const Lanes& a, const Lanes& b) { return a < b ? a : b; }
    static Lanes most(const Lanes& a, const Lanes& b) { return a > b ? a : b; }

    /// Möller and Trumbore's test without divisions, with a bound on the rounding of sums of products: true only for
    /// triangles that the ray certainly misses.
    /// Source: Möller and Trumbore 1997, "Fast, minimum storage ray/triangle intersection"; the bounds are ours.
    [[nodiscard]] auto misses(std::size_t first, const Ray<T>& ray, T t_max) const {
        const auto all = [](const Vec3<T>& v) { return Vectors{Lanes{} + v.x, Lanes{} + v.y, Lanes{} + v.z}; };
        const auto vertices = [&](std::size_t i) {
            Vectors v;
            std::memcpy(&v.x, &vertices_[i][0][first], sizeof v.x);
            std::memcpy(&v.y, &vertices_[i][1][first], sizeof v.y);
            std::memcpy(&v.z, &vertices_[i][2][first], sizeof v.z);
            return v;
        };
        const Vectors d = all(ray.direction), a = vertices(0), to_a = a.minus(all(ray.origin));
        const Vectors ab = vertices(1).minus(a), ac = vertices(2).minus(a);
        const Vectors d_ac = d.cross(ac), a_ab = to_a.cross(ab);
        // With n = ab × ac the slope is n · d, the height n · (a − o): t is their ratio. u, v and w are
        // barycentric coordinates, times the slope.
        const Lanes slope = -d_ac.dot(ab), height = a_ab.dot(ac);
        const Lanes v = d_ac.dot(to_a), w = a_ab.dot(d), u = slope - v - w;

        const T scale = T(16) * std::numeric_limits<T>::epsilon() * longest_;
        const Lanes size = absolute(to_a.x) + absolute(to_a.y) + absolute(to_a.z) + longest_;
        const Lanes bound = scale * T(magnitude(ray.direction)) * size, height_bound = scale * longest_ * size;
        const Lanes steepness = absolute(slope), ahead = slope < 0 ? -height : height;
        return ((least(u, least(v, w)) < -bound) & (most(u, most(v, w)) > bound)) |
               (ahead + height_bound < ray.t_min * (steepness - bound)) |
               (ahead - height_bound > t_max * (steepness + bound));
    }

    std::array<std::array<std::array<T, lanes>, 3>, 3> vertices_{}; ///< by vertex, then axis
    T longest_ = T(0); ///< the longest edge of all triangles, by the sum of its components
    std::array<std::uint32_t, lanes> triangles_{};
};

} // namespace nephroid::examples
