// SPDX-License-Identifier: MIT
/// @file  A torus in a block of glass: figure 13 of Frisvad et al. 2014.
#pragma once

#include "common/scenes/placing.hpp"
#include "common/scenes/revolve.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace nephroid::examples::detail {

/// A torus of radii 0.6 and 0.2 in a cube of glass that hovers over the ground.
template <class T, Flux F>
[[nodiscard]] Room<T, F> embedded_torus_scene() {
    enum : std::uint32_t { white, red, lamp, glass };
    MeshData<T> mesh;
    add_ground(mesh, 12, white);
    mesh.normals.resize(mesh.positions.size(), Vec3<T>(0));
    add_revolved(mesh, circle(0.6, 0.2, 64), 192, red);
    const T c = T(std::cos(35 * std::numbers::pi / 180)), s = T(std::sin(35 * std::numbers::pi / 180));
    const auto tilted = [&](const Vec3<T>& v) { return Vec3<T>(v.x, c * v.y - s * v.z, s * v.y + c * v.z); };
    for (std::size_t i = 4; i < mesh.positions.size(); ++i) { // all but the ground
        mesh.positions[i] = tilted(mesh.positions[i]) + Vec3<T>(0, T(1.25), 0);
        mesh.normals[i] = tilted(mesh.normals[i]);
    }
    const Vec3<T> above(T(1.5), T(5.25), T(1));
    MeshData<T> lamp_mesh;
    add_disk(lamp_mesh, above, normalize(Vec3<T>(0, T(1.25), 0) - above), T(0.2), lamp);
    MeshData<T> cube;
    add_block(cube, Box<T>{{T(-1), T(0.25), T(-1)}, {T(1), T(2.25), T(1)}}, glass);
    const double radiance = 20 / (std::numbers::pi * square(0.2));
    Room<T, F> room({{TriangleMesh<T>(std::move(mesh)), white},
                     {TriangleMesh<T>(std::move(lamp_mesh)), white},
                     {TriangleMesh<T>(std::move(cube)), white}},
                    {Material<F>::diffuse(grey<F>(0.8)), Material<F>::diffuse(color_from_rgb<F>({0.8f, 0.3f, 0.2f})),
                     Material<F>::emitter(grey<F>(radiance)), Material<F>::dielectric(1.5)});
    look(room.camera, {-2.2f, 3.4f, 4.6f}, {0, 1, 0}, 0.62f);
    return room;
}

} // namespace nephroid::examples::detail
