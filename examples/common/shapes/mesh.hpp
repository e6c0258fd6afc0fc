// SPDX-License-Identifier: MIT
/// @file  A triangle mesh, smooth where it has vertex normals, without cracks between its triangles.
#pragma once

#include "common/bvh.hpp"
#include "common/shapes/mesh_data.hpp"
#include "common/shapes/triangle_block.hpp"

#include "nephroid/differential/interpolated_curvature.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace nephroid::examples {

/// Triangles in a tree, whose leaves are blocks of four.
template <class T>
class TriangleMesh {
    using wide = wide_t<T>;
    using WideVec3 = Vec3<wide>;
    using Block = TriangleBlock<T>;

public:
    /// Throws std::invalid_argument for an index out of range, a vertex that is not finite, and counts that differ.
    explicit TriangleMesh(MeshData<T> data) : data_(std::move(data)) {
        validate(data_);
        std::vector<Box<T>> boxes;
        boxes.reserve(data_.triangles.size());
        for (std::size_t i = 0; i < data_.triangles.size(); ++i) {
            boxes.emplace_back();
            for (const Vec3<T>& p : data_.corners(i))
                boxes.back().add(p);
        }
        bvh_ = Bvh<T>(boxes, Block::lanes);
        blocks_.reserve(bvh_.leaf_count());
        for (std::size_t leaf = 0; leaf < bvh_.leaf_count(); ++leaf)
            blocks_.emplace_back(data_, bvh_.leaf(leaf));
    }

    [[nodiscard]] const MeshData<T>& data() const { return data_; }
    [[nodiscard]] Box<T> bounds() const { return bvh_.bounds(); }

    [[nodiscard]] std::array<Vec3<T>, 3> corners(std::size_t triangle) const { return data_.corners(triangle); }

    [[nodiscard]] std::uint32_t material(std::size_t triangle) const {
        return data_.materials.empty() ? 0 : data_.materials[triangle];
    }

    /// The barycentric coordinates, of the second and the third corner, of a point on a triangle.
    [[nodiscard]] std::array<wide, 2> barycentric(std::size_t triangle, const Vec3<T>& point) const {
        const auto [p0, p1, p2] = corners(triangle);
        const WideVec3 e1 = widen(p1) - widen(p0), e2 = widen(p2) - widen(p0), from_p0 = widen(point) - widen(p0);
        const WideVec3 face = wide_cross<T>(e1, e2);
        const wide area2 = dot(face, face);
        return {dot(wide_cross<T>(from_p0, e2), face) / area2, dot(wide_cross<T>(e1, from_p0), face) / area2};
    }

    [[nodiscard]] std::optional<Candidate<T>> nearest(const Ray<T>& ray, wide t_max) const {
        return search(ray, t_max, false, AnyOrder());
    }

    /// The nearest hit that is not left out. If surfaces touch there, the order says which one comes first.
    template <class Order>
    [[nodiscard]] std::optional<Candidate<T>> nearest(const Ray<T>& ray, wide t_max, const Order& order) const {
        return search(ray, t_max, false, order);
    }

    /// Any hit, not the nearest one.
    [[nodiscard]] bool occludes(const Ray<T>& ray) const {
        return search(ray, wide(ray.t_max), true, AnyOrder()).has_value();
    }

    /// The cosine between a ray of unit direction and a triangle's normal.
    [[nodiscard]] wide cosine(const Ray<T>& ray, std::uint32_t triangle) const {
        const auto [p0, p1, p2] = corners(triangle);
        return dot(widen(ray.direction), normalize(wide_cross<T>(widen(p1) - widen(p0), widen(p2) - widen(p0))));
    }

    /// The hit; its `surface` is the triangle's material. Each return constructs the whole hit in place, because it
    /// stalls the processor to write a hit member by member and then copy it.
    [[nodiscard]] Hit<T> hit(const Ray<T>&, const Candidate<T>& candidate) const {
        const auto [p0, p1, p2] = corners(candidate.primitive);
        const WideVec3 e1 = widen(p1) - widen(p0), e2 = widen(p2) - widen(p0);
        const wide u = candidate.u, v = candidate.v;
        const WideVec3 face = wide_cross<T>(e1, e2);
        const Vec3<T> position(widen(p0) + (u * e1 + v * e2)), geometric(normalize(face));
        const T error = position_error(position, magnitude(p0) + magnitude(e1) + magnitude(e2));
        const std::size_t surface = material(candidate.primitive);
        const auto& t = data_.triangles[candidate.primitive];
        if (!data_.normals.empty()) {
            const WideVec3 n0 = widen(data_.normals[t[0]]), n1 = widen(data_.normals[t[1]]),
                           n2 = widen(data_.normals[t[2]]);
            const WideVec3 n = n0 + (u * (n1 - n0) + v * (n2 - n0));
            const wide side = dot(n, face); // zero: no normals here, or one that lies in the triangle's plane
            if (n0 != WideVec3(0) && n1 != WideVec3(0) && n2 != WideVec3(0) && side != 0) {
                const wide sign = side < 0 ? -1 : 1; // the shading normal is on the geometric one's side
                return {T(candidate.distance),
                        position,
                        geometric,
                        Vec3<T>(sign * normalize(n)),
                        interpolated_normals<Vec3<T>>(p0, p1, p2, Vec3<T>(sign * n0), Vec3<T>(sign * n1),
                                                      Vec3<T>(sign * n2), T(u), T(v)),
                        error,
                        surface};
            }
        }
        return {T(candidate.distance), position, geometric, geometric, Flat{}, error, surface};
    }

private:
    template <class Order>
    [[nodiscard]] std::optional<Candidate<T>> search(const Ray<T>& ray, wide t_max, bool any,
                                                     const Order& order) const {
        std::optional<Candidate<T>> best;
        const auto visit = [&](std::uint32_t leaf, T nearest) {
            const Block& block = blocks_[leaf];
            for (unsigned passes = block.filter(ray, nearest); passes != 0; passes &= passes - 1)
                if (const auto found = block.decide(std::size_t(std::countr_zero(passes)), ray, t_max)) {
                    if constexpr (Order::matters) {
                        if (!comes_first(ray, *found, best, order))
                            continue;
                        best = found;
                        t_max = (std::min)(t_max, found->distance + flattest * contact_height(ray, found->distance));
                    } else {
                        best = found;
                        t_max = found->distance;
                    }
                }
            return best && any ? -std::numeric_limits<T>::infinity() : T(t_max);
        };
        bvh_.traverse({ray.origin, ray.direction, ray.t_min, T(t_max)}, visit,
                      [this](std::uint32_t leaf) { prefetch(&blocks_[leaf]); });
        return best;
    }

    static constexpr wide flattest = 16; ///< 1 / sine of the flattest ray whose contacts are considered

    /// Whether a hit is not left out, and comes before the best one so far. Hits on the same material come in the order
    /// of their distances, because a ray may come through the edge of a body.
    template <class Order>
    [[nodiscard]] bool comes_first(const Ray<T>& ray, const Candidate<T>& found,
                                   const std::optional<Candidate<T>>& best, const Order& order) const {
        const auto slope = [&] { return cosine(ray, found.primitive); };
        if (order.leaves_out(found.primitive, found.distance, slope))
            return false;
        if (!best)
            return true;
        const bool is_nearer = found.distance < best->distance;
        const std::uint32_t mine = material(found.primitive), others = material(best->primitive);
        const wide apart = abs(found.distance - best->distance), height = contact_height(ray, found.distance);
        if (mine == others || apart > flattest * height || apart * wide(abs(slope())) > height)
            return is_nearer;
        const int rank = order.rank(mine, slope() > 0), other = order.rank(others, cosine(ray, best->primitive) > 0);
        return rank < other || (rank == other && is_nearer);
    }

    MeshData<T> data_;
    Bvh<T> bvh_;
    std::vector<Block> blocks_; ///< by leaf
};

} // namespace nephroid::examples
