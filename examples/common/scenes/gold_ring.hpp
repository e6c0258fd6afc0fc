// SPDX-License-Identifier: MIT
/// @file  A gold ring on a table under a round lamp: figures 1 and 2 of Frisvad et al. 2014.
#pragma once

#include "common/scenes/placing.hpp"
#include "common/scenes/revolve.hpp"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace nephroid::examples::detail {

template <class T, Flux F>
[[nodiscard]] Room<T, F> gold_ring_scene() {
    enum : std::uint32_t { table, gold, lamp };
    const double elevation = 40 * std::numbers::pi / 180, distance = 6, radius = 0.3;
    const double radiance = square(distance / radius) / (std::numbers::pi * std::sin(elevation)); // 1 on the table
    std::vector<Material<F>> materials = {
        Material<F>::diffuse(grey<F>(0.9)),
        Material<F>::conductor(color_from_rgb<F>({0.14f, 0.43f, 1.38f}), color_from_rgb<F>({3.697f, 2.455f, 1.914f})),
        Material<F>::emitter(grey<F>(radiance))};
    MeshData<T> mesh;
    add_ground(mesh, 8, table);
    const Vec3<T> above(T(distance * std::cos(elevation)), T(distance * std::sin(elevation)), T(0));
    add_disk(mesh, above, normalize(Vec3<T>(-above)), T(radius), lamp);
    add_revolved(mesh, rounded_rectangle(1, 1.12, 0, 0.5, 0.04, 8), 512, gold);
    Room<T, F> room({{TriangleMesh<T>(std::move(mesh)), table}}, std::move(materials));
    look(room.camera, {-1.5f, 3, 3.5f}, {0.2f, 0.1f, 0}, 0.61f);
    return room;
}

} // namespace nephroid::examples::detail
