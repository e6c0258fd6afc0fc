// SPDX-License-Identifier: MIT
/// @file  A triangle mesh, smooth where it has vertex normals, without cracks between its triangles.
#pragma once

#include "common/bvh.hpp"
#include "common/registers.hpp"

#include "nephroid/vector/error.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace nephroid::examples {

template <class T>
struct MeshData {
    std::vector<Vec3<T>> positions;
    std::vector<Vec3<T>> normals; ///< one for each position, of any length; zero, or no normals at all: flat
    std::vector<std::array<std::uint32_t, 3>> triangles; ///< counter-clockwise seen from where the normal points
    std::vector<std::uint32_t> materials;                ///< one for each triangle; empty: all are material 0
};

/// Leaves hold up to four triangles in structure-of-arrays order. A test in T of all four lets through what might be
/// hit, with a bound on its rounding; what passes is decided in `wide`, with a bound on that. So no ray passes between
/// triangles that share an edge, and a hit is as exact as its vertices are.
template <class T>
class TriangleMesh {
    using wide = wide_t<T>;
    using WideVec3 = Vec3<wide>;

public:
    /// Throws std::invalid_argument for an index out of range, a vertex that is not finite, and counts that differ.
    explicit TriangleMesh(MeshData<T> data) : data_(std::move(data)) {
        validate();
        std::vector<Box<T>> boxes;
        boxes.reserve(data_.triangles.size());
        for (std::size_t i = 0; i < data_.triangles.size(); ++i) {
            boxes.emplace_back();
            for (const Vec3<T>& p : corners(i))
                boxes.back().add(p);
        }
        bvh_ = Bvh<T>(boxes, lanes);
        blocks_.reserve(bvh_.leaf_count());
        for (std::size_t leaf = 0; leaf < bvh_.leaf_count(); ++leaf)
            blocks_.push_back(block_of(bvh_.leaf(leaf)));
    }

    [[nodiscard]] const MeshData<T>& data() const { return data_; }
    [[nodiscard]] Box<T> bounds() const { return bvh_.bounds(); }

    [[nodiscard]] std::array<Vec3<T>, 3> corners(std::size_t triangle) const {
        const auto& t = data_.triangles[triangle];
        return {data_.positions[t[0]], data_.positions[t[1]], data_.positions[t[2]]};
    }

    [[nodiscard]] std::uint32_t material(std::size_t triangle) const {
        return data_.materials.empty() ? 0 : data_.materials[triangle];
    }

    [[nodiscard]] std::optional<Candidate<T>> nearest(const Ray<T>& ray, wide t_max) const {
        return search(ray, t_max, false, AnyOrder());
    }

    /// The nearest of those that are not left out; of several that touch, the first.
    template <class Order>
    [[nodiscard]] std::optional<Candidate<T>> nearest(const Ray<T>& ray, wide t_max, const Order& order) const {
        return search(ray, t_max, false, order);
    }

    /// Any hit, not the nearest one.
    [[nodiscard]] bool occludes(const Ray<T>& ray) const {
        return search(ray, wide(ray.t_max), true, AnyOrder()).has_value();
    }

    /// Between a ray of unit length and a triangle's normal.
    [[nodiscard]] wide cosine(const Ray<T>& ray, std::uint32_t triangle) const {
        const auto [p0, p1, p2] = corners(triangle);
        return dot(widen(ray.direction), normalize(wide_cross<T>(widen(p1) - widen(p0), widen(p2) - widen(p0))));
    }

    /// `surface` is the triangle's material. Every hit is written once, where it is returned: what is put together in
    /// parts and then copied waits for its parts.
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
    static constexpr std::size_t lanes = 4;
    /// The triangles of a leaf; vacant lanes repeat the first.
    struct alignas(16) Block {
        std::array<std::array<std::array<T, lanes>, 3>, 3> vertices; ///< by vertex, then axis
        T longest; ///< edge of any of them, by the sum of its components
        std::array<std::uint32_t, lanes> triangles;
    };

    void validate() const {
        const auto complain = [](const std::string& what) { invalid_argument("TriangleMesh: " + what); };
        for (std::size_t i = 0; i < data_.positions.size(); ++i)
            if (!all_finite(T(16) * data_.positions[i]))
                complain("vertex " + std::to_string(i) + " is not finite");
        for (const auto& triangle : data_.triangles)
            for (const std::uint32_t index : triangle)
                if (index >= data_.positions.size())
                    complain("a triangle's index " + std::to_string(index) + " is out of range");
        if (!data_.normals.empty() && data_.normals.size() != data_.positions.size())
            complain("there must be as many normals as positions, or none");
        for (std::size_t i = 0; i < data_.normals.size(); ++i)
            if (!all_finite(data_.normals[i]))
                complain("normal " + std::to_string(i) + " is not finite");
        if (!data_.materials.empty() && data_.materials.size() != data_.triangles.size())
            complain("there must be as many materials as triangles, or none");
    }

    [[nodiscard]] Block block_of(std::span<const std::uint32_t> triangles) const {
        Block block{};
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            const std::uint32_t triangle = triangles[lane < triangles.size() ? lane : 0];
            const auto points = corners(triangle);
            block.triangles[lane] = triangle;
            for (std::size_t i = 0; i < 3; ++i) {
                for (std::size_t axis = 0; axis < 3; ++axis)
                    block.vertices[i][axis][lane] = points[i][int(axis)];
                block.longest = (std::max)(block.longest, T(magnitude(points[(i + 1) % 3] - points[i])));
            }
        }
        return block;
    }

    template <class Order>
    [[nodiscard]] std::optional<Candidate<T>> search(const Ray<T>& ray, wide t_max, bool any,
                                                     const Order& order) const {
        std::optional<Candidate<T>> best;
        const auto visit = [&](std::uint32_t leaf, T nearest) {
            const Block& block = blocks_[leaf];
            for (unsigned passes = filter(block, ray, nearest); passes != 0; passes &= passes - 1)
                if (const auto found = decide(block, std::size_t(std::countr_zero(passes)), ray, t_max)) {
                    if constexpr (Order::matters) {
                        if (!comes_first(ray, *found, best, order))
                            continue;
                        best = found;
                        t_max = (std::min)(t_max, found->distance + most_lean * contact_height(ray, found->distance));
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

    static constexpr wide most_lean = 16; ///< flatter rays tell distances less well than counts here

    /// Whether a hit is to be met, and before the best one so far. Hits on one material come in the order of their
    /// distances: a ray may come through the edge of a body.
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
        if (mine == others || apart > most_lean * height || apart * wide(abs(slope())) > height)
            return is_nearer;
        const int rank = order.rank(mine, slope() > 0), other = order.rank(others, cosine(ray, best->primitive) > 0);
        return rank < other || (rank == other && is_nearer);
    }

    using Lanes = typename RegisterOf<T>::type;

    /// As many vectors as a register has lanes.
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

    /// Möller and Trumbore's test without its divisions, with a bound on the rounding of sums of products: what does
    /// not pass is certainly missed.
    /// Source: Möller and Trumbore 1997, "Fast, minimum storage ray/triangle intersection"; the bounds are ours.
    [[nodiscard]] static auto misses(const Block& block, std::size_t first, const Ray<T>& ray, T t_max) {
        const auto all = [](const Vec3<T>& v) { return Vectors{Lanes{} + v.x, Lanes{} + v.y, Lanes{} + v.z}; };
        const auto vertices = [&](std::size_t i) {
            Vectors v;
            std::memcpy(&v.x, &block.vertices[i][0][first], sizeof v.x);
            std::memcpy(&v.y, &block.vertices[i][1][first], sizeof v.y);
            std::memcpy(&v.z, &block.vertices[i][2][first], sizeof v.z);
            return v;
        };
        const Vectors d = all(ray.direction), a = vertices(0), to_a = a.minus(all(ray.origin));
        const Vectors ab = vertices(1).minus(a), ac = vertices(2).minus(a);
        const Vectors d_ac = d.cross(ac), a_ab = to_a.cross(ab);
        // With n = ab × ac the slope is n · d, the height n · (a − o): t is their ratio. u, v and w are
        // barycentric coordinates, times the slope.
        const Lanes slope = -d_ac.dot(ab), height = a_ab.dot(ac);
        const Lanes v = d_ac.dot(to_a), w = a_ab.dot(d), u = slope - v - w;

        const T scale = T(16) * std::numeric_limits<T>::epsilon() * block.longest;
        const Lanes size = absolute(to_a.x) + absolute(to_a.y) + absolute(to_a.z) + block.longest;
        const Lanes bound = scale * T(magnitude(ray.direction)) * size, height_bound = scale * block.longest * size;
        const Lanes steepness = absolute(slope), ahead = slope < 0 ? -height : height;
        return ((least(u, least(v, w)) < -bound) & (most(u, most(v, w)) > bound)) |
               (ahead + height_bound < ray.t_min * (steepness - bound)) |
               (ahead - height_bound > t_max * (steepness + bound));
    }

    /// Which of a leaf's triangles the ray may hit, as bits.
    [[nodiscard]] static unsigned filter(const Block& block, const Ray<T>& ray, T t_max) {
        decltype(Lanes{} < Lanes{}) missed{};
        for (std::size_t first = 0; first < lanes; first += RegisterOf<T>::lanes)
            missed |= bits_from(first, misses(block, first, ray, t_max));
        return ~all_bits(missed) & ((1u << lanes) - 1);
    }

    /// Plücker's test in `wide`, in which triangles that share an edge compute the same for it, and the hit's place. A
    /// triangle that the ray meets edge-on is not hit: its neighbours are.
    /// Source: Davis et al. 2012 as in Embree; the bounds are ours.
    [[nodiscard]] static std::optional<Candidate<T>> decide(const Block& block, std::size_t lane, const Ray<T>& ray,
                                                            wide t_max) {
        const WideVec3 o = widen(ray.origin), d = widen(ray.direction);
        const auto vertex = [&](std::size_t i) {
            const auto& v = block.vertices[i];
            return WideVec3(v[0][lane], v[1][lane], v[2][lane]) - o;
        };
        const WideVec3 a = vertex(0), b = vertex(1), c = vertex(2);
        const wide bound = 8 * std::numeric_limits<wide>::epsilon() * wide(block.longest) *
                           (magnitude(a) + wide(block.longest)) * magnitude(d);
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
        // What lies outside by rounding is put onto the edge.
        const wide sign = most > bound ? 1 : -1;
        const wide inner_u = (std::max)(0.0, sign * u), inner_v = (std::max)(0.0, sign * v);
        const wide sum = inner_u + inner_v + (std::max)(0.0, sign * w);
        return Candidate<T>{t, inner_u / sum, inner_v / sum, block.triangles[lane]};
    }

    MeshData<T> data_;
    Bvh<T> bvh_;
    std::vector<Block> blocks_; ///< by leaf
};

} // namespace nephroid::examples
