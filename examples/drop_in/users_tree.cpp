// SPDX-License-Identifier: MIT
/// @file  Caustics in a renderer of triangles over a plain tree: madmann91's bvh v2 where its headers are found, with
///        its vectors, and else the tree of these examples, with GLM's.
#include "picture.hpp"

#if __has_include(<bvh/v2/bvh.h>)
#include <bvh/v2/bvh.h>
#include <bvh/v2/default_builder.h>
#include <bvh/v2/node.h>
#include <bvh/v2/ray.h>
#include <bvh/v2/stack.h>
#include <bvh/v2/thread_pool.h>
#include <bvh/v2/tri.h>
#include <bvh/v2/vec.h>
#define USES_BVH_V2
#else
#include "common/bvh.hpp"

#include <glm/geometric.hpp>
#endif

#include <array>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

/// The renderer as it was before.
namespace renderer {

#if defined(USES_BVH_V2)
using Vec = bvh::v2::Vec<float, 3>;
#else
using Vec = glm::vec3;
#endif

struct Triangle {
    std::array<Vec, 3> p, n; ///< corners, and the shading normals there
    bool is_glass;
};

struct TriangleHit {
    float t, u, v; ///< distance, and barycentric coordinates of corners 1 and 2
    const Triangle* triangle;
};

/// Möller and Trumbore's test.
std::optional<TriangleHit> intersect(const Triangle& triangle, const Vec& o, const Vec& d, float t_min, float t_max) {
    const Vec e1 = triangle.p[1] - triangle.p[0], e2 = triangle.p[2] - triangle.p[0], s = o - triangle.p[0];
    const Vec de2 = cross(d, e2), se1 = cross(s, e1);
    const float inverse = 1 / dot(e1, de2);
    const float u = inverse * dot(s, de2), v = inverse * dot(d, se1), t = inverse * dot(e2, se1);
    if (u >= 0 && v >= 0 && u + v <= 1 && t > t_min && t < t_max)
        return TriangleHit{t, u, v, &triangle};
    return std::nullopt;
}

class World {
public:
    explicit World(const std::vector<Triangle>& triangles);
    [[nodiscard]] std::optional<TriangleHit> nearest(const Vec& o, const Vec& d, float t_min, float t_max) const;

private:
    std::vector<Triangle> triangles_; ///< in the order of the tree
#if defined(USES_BVH_V2)
    bvh::v2::Bvh<bvh::v2::Node<float, 3>> tree_;
#else
    nephroid::examples::Bvh<float> tree_;
    std::vector<std::size_t> leaf_begin_;
#endif
};

#if defined(USES_BVH_V2)
World::World(const std::vector<Triangle>& triangles) {
    std::vector<bvh::v2::BBox<float, 3>> boxes;
    std::vector<Vec> centers;
    for (const Triangle& triangle : triangles) {
        const bvh::v2::Tri<float, 3> tri(triangle.p[0], triangle.p[1], triangle.p[2]);
        boxes.push_back(tri.get_bbox());
        centers.push_back(tri.get_center());
    }
    tree_ = bvh::v2::DefaultBuilder<bvh::v2::Node<float, 3>>::build(boxes, centers);
    for (const std::size_t i : tree_.prim_ids)
        triangles_.push_back(triangles[i]);
}

std::optional<TriangleHit> World::nearest(const Vec& o, const Vec& d, float t_min, float t_max) const {
    std::optional<TriangleHit> nearest;
    bvh::v2::Ray<float, 3> ray(o, d, t_min, t_max);
    bvh::v2::SmallStack<decltype(tree_)::Index, 64> stack;
    tree_.intersect<false, true>(ray, tree_.get_root().index, stack, [&](std::size_t begin, std::size_t end) {
        bool found = false;
        for (std::size_t i = begin; i < end; ++i)
            if (const auto hit = intersect(triangles_[i], o, d, t_min, ray.tmax)) {
                nearest = hit;
                ray.tmax = hit->t;
                found = true;
            }
        return found;
    });
    return nearest;
}
#else
World::World(const std::vector<Triangle>& triangles) {
    std::vector<nephroid::examples::Box<float>> boxes;
    for (const Triangle& triangle : triangles) {
        boxes.emplace_back();
        for (const Vec& corner : triangle.p)
            boxes.back().add(corner);
    }
    tree_ = nephroid::examples::Bvh<float>(boxes);
    for (std::size_t leaf = 0; leaf < tree_.leaf_count(); ++leaf) {
        leaf_begin_.push_back(triangles_.size());
        for (const std::uint32_t i : tree_.leaf(leaf))
            triangles_.push_back(triangles[i]);
    }
    leaf_begin_.push_back(triangles_.size());
}

std::optional<TriangleHit> World::nearest(const Vec& o, const Vec& d, float t_min, float t_max) const {
    std::optional<TriangleHit> nearest;
    tree_.traverse({o, d, t_min, t_max}, [&](std::uint32_t leaf, float reach) {
        for (std::size_t i = leaf_begin_[leaf]; i < leaf_begin_[leaf + 1]; ++i)
            if (const auto hit = intersect(triangles_[i], o, d, t_min, reach)) {
                nearest = hit;
                reach = hit->t;
            }
        return reach;
    });
    return nearest;
}
#endif

void add_ball(std::vector<Triangle>& triangles, const Vec& centre, float radius, int longitudes, int latitudes) {
    const double pi = std::numbers::pi;
    const auto normal = [&](int i, int j) {
        const double theta = pi * j / latitudes, phi = 2 * pi * (i % longitudes) / longitudes;
        return Vec(float(std::sin(theta) * std::cos(phi)), float(std::sin(theta) * std::sin(phi)),
                   float(std::cos(theta)));
    };
    const auto add = [&](const Vec& a, const Vec& b, const Vec& c) {
        triangles.push_back({{centre + radius * a, centre + radius * b, centre + radius * c}, {a, b, c}, true});
    };
    for (int j = 0; j < latitudes; ++j)
        for (int i = 0; i < longitudes; ++i) {
            if (j > 0)
                add(normal(i, j), normal(i, j + 1), normal(i + 1, j));
            if (j + 1 < latitudes)
                add(normal(i + 1, j), normal(i, j + 1), normal(i + 1, j + 1));
        }
}

void add_floor(std::vector<Triangle>& triangles, float reach) {
    const Vec up(0, 0, 1), a(-reach, -reach, 0), b(reach, -reach, 0), c(-reach, reach, 0), d(reach, reach, 0);
    triangles.push_back({{a, b, c}, {up, up, up}, false});
    triangles.push_back({{c, b, d}, {up, up, up}, false});
}

/// Where a pixel's ray has ended on a diffuse surface.
struct Seen {
    Vec position, normal;
    std::size_t pixel;
};

/// An orthographic camera that looks down at [-1/2, 1/2]²; here it sees the floor through the ball.
std::vector<Seen> trace_camera(std::size_t size) {
    std::vector<Seen> seen;
    const auto at = [size](std::size_t i) { return (float(i) + 0.5f) / float(size) - 0.5f; };
    for (std::size_t pixel = 0; pixel < size * size; ++pixel)
        seen.push_back({Vec(at(pixel % size), at(pixel / size), 0.f), Vec(0, 0, 1), pixel});
    return seen;
}

} // namespace renderer

// adapter begins
#include <nephroid/nephroid.hpp>

using renderer::Vec;

#if defined(USES_BVH_V2)
// How nephroid reads and makes the tree's vector; it then uses the operators that the vector has.
template <>
struct nephroid::vector_traits<Vec> {
    using scalar = float;
    static Vec make(float x, float y, float z) { return Vec(x, y, z); }
    static float x(const Vec& v) { return v[0]; }
    static float y(const Vec& v) { return v[1]; }
    static float z(const Vec& v) { return v[2]; }
};
#else
#include <nephroid/vector/glm.hpp> // the same for GLM's
#endif

// The renderer's world as a scene that photons walk through.
struct CausticScene {
    using Hit =
        nephroid::SurfaceHit<Vec, nephroid::InterpolatedCurvature<Vec>>; // flat triangles have three equal normals
    using Scattering = nephroid::Scattering<float, float>;
    const renderer::World& world;

    std::optional<Hit> intersect(const Vec& origin, const Vec& direction, float t_min, float t_max) const {
        const auto found = world.nearest(origin, direction, t_min, t_max);
        if (!found)
            return std::nullopt;
        const auto& [p, n, is_glass] = *found->triangle;
        const Vec e1 = p[1] - p[0], e2 = p[2] - p[0];
        Hit hit;
        hit.distance = found->t;
        hit.position = p[0] + (found->u * e1 + found->v * e2); // on the triangle but for rounding, unlike o + t d
        hit.geometric_normal = normalize(cross(e1, e2));       // of the triangle: says which side a ray comes from
        hit.shading_normal =
            normalize(n[0] + (found->u * (n[1] - n[0]) + found->v * (n[2] - n[0]))); // light goes by this
        hit.curvature = nephroid::interpolated_normals(p[0], p[1], p[2], n[0], n[1], n[2], found->u, found->v);
        hit.position_error =
            nephroid::rounding_error(origin, found->t, hit.position); // the next ray starts off by this
        hit.surface = is_glass ? 1 : 0;                               // comes back in `scatter`
        return hit;
    }

    Scattering scatter(const Hit& hit, const Vec& direction, auto& /*random numbers*/) const {
        if (hit.surface == 0)
            return Scattering::deposit(); // diffuse: the photon is splatted
        const bool entering = dot(direction, hit.geometric_normal) < 0;
        return Scattering::refract(1, entering ? 1 / 1.5f : 1.5f); // the whole flux; n before over n behind
    }
};

// Adds the caustics' irradiance to each pixel's.
void add_caustics(const renderer::World& world, const std::vector<renderer::Seen>& seen, std::vector<float>& film) {
    const nephroid::EyePathMap map(seen, &renderer::Seen::position, &renderer::Seen::normal);
    auto sums = nephroid::sums<float>(map);
    const nephroid::BoundingSphere<Vec> glass{Vec(0, 0, 1.25f), 1}; // what the sun is aimed at
    const nephroid::DirectionalLight<Vec, float> sun({.direction = Vec(0, 0, -1), .irradiance = 1, .patch = glass});
    nephroid::ThreadExecutor threads;
    for (const std::string& sentence : nephroid::diagnose(
             nephroid::caustics(CausticScene{world}, sun, sums, {.count = 50'000, .smoothing = 5}, threads)))
        std::cerr << sentence << '\n';
    sums.for_each([&](std::size_t i, float irradiance) { film[seen[i].pixel] += irradiance; });
}
// adapter ends

int main(int argc, char** argv) {
    std::vector<renderer::Triangle> triangles;
    renderer::add_floor(triangles, 9);
    renderer::add_ball(triangles, Vec(0, 0, 1.25f), 1, 512, 256);

    constexpr std::size_t size = 256;
    std::vector<float> film(size * size);
    add_caustics(renderer::World(triangles), renderer::trace_camera(size), film);
    return write_pfm(argc > 1 ? argv[1] : "users_tree.pfm", size, 1, film) ? 0 : 1;
}
