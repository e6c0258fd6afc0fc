// SPDX-License-Identifier: MIT
/// @file  The specular objects of a scene, as what lamps are aimed at: each triangle of its meshes, each other shape.
#pragma once

#include "common/scene.hpp"

#include "nephroid/emission/target_groups.hpp"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <variant>
#include <vector>

namespace nephroid::examples {

template <class T>
struct SpecularObjects {
    std::vector<BoundingSphere<Vec3<T>>> bounds;         ///< around each of them
    std::vector<std::pair<std::size_t, std::size_t>> at; ///< the part and, in a mesh, the triangle

    /// Points whose convex hull contains some of the objects.
    template <Flux F>
    [[nodiscard]] std::vector<Vec3<T>> points(const Scene<T, F>& scene, const std::vector<std::size_t>& which) const {
        std::vector<Vec3<T>> points;
        for (const std::size_t i : which) {
            const auto& part = scene.parts()[at[i].first];
            if (const auto* mesh = std::get_if<TriangleMesh<T>>(&part.shape)) {
                for (const Vec3<T>& corner : mesh->corners(at[i].second))
                    points.push_back(corner);
            } else {
                const Box<T> box = scene.bounds_of(part);
                for (int corner = 0; corner < 8; ++corner)
                    points.push_back(box.corner(corner));
            }
        }
        return points;
    }
};

/// All bounded specular objects that have an extent.
template <class T, Flux F>
[[nodiscard]] SpecularObjects<T> specular_objects(const Scene<T, F>& scene) {
    SpecularObjects<T> objects;
    const auto add = [&](const BoundingSphere<Vec3<T>>& bounds, std::size_t part, std::size_t triangle) {
        if (!(bounds.radius > T(0)))
            return;
        objects.bounds.push_back(bounds);
        objects.at.emplace_back(part, triangle);
    };
    for (std::size_t i = 0; i < scene.parts().size(); ++i) {
        const auto& part = scene.parts()[i];
        if (const auto* mesh = std::get_if<TriangleMesh<T>>(&part.shape)) {
            for (std::size_t triangle = 0; triangle < mesh->data().triangles.size(); ++triangle)
                if (scene.materials()[mesh->material(triangle)].is_specular())
                    add(bounding_sphere(mesh->corners(triangle)), i, triangle);
        } else if (scene.materials()[part.material].is_specular()) {
            const Box<T> box = scene.bounds_of(part);
            if (!box.is_finite())
                continue;
            const Vec3<T> half = T(0.5) * (box.max - box.min);
            // A ball touches its box from within; other shapes may reach into its corners.
            const bool is_ball = std::holds_alternative<Sphere<T>>(part.shape);
            add({box.min + half, is_ball ? half.x : length(half)}, i, 0);
        }
    }
    return objects;
}

} // namespace nephroid::examples
