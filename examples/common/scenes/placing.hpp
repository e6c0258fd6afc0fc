// SPDX-License-Identifier: MIT
/// @file  What the scenes that are built in have in common: a ground, a round lamp, a camera.
#pragma once

#include "common/camera_from_gltf.hpp"
#include "common/rooms.hpp"

#include <cmath>
#include <cstdint>

namespace nephroid::examples::detail {

inline void look(CameraDescription& camera, const glm::vec3& from, const glm::vec3& to, float yfov) {
    camera.position = from;
    camera.forward = normalize(to - from);
    camera.right = normalize(cross(camera.forward, glm::vec3(0, 1, 0)));
    camera.up = cross(camera.right, camera.forward);
    camera.yfov = yfov;
}

/// Adds a square of the ground y = 0.
template <class T>
void add_ground(MeshData<T>& mesh, double reach, std::uint32_t material) {
    const T r = T(reach);
    add_face<T>(mesh, {-r, 0, -r}, {-r, 0, r}, {r, 0, r}, {r, 0, -r}, material);
}

/// Adds a disk, as a fan of triangles.
///
/// @param normal  unit
template <class T>
void add_disk(MeshData<T>& mesh, const Vec3<T>& centre, const Vec3<T>& normal, T radius, std::uint32_t material) {
    constexpr std::uint32_t corners = 48;
    const auto frame = frame_about(normal);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.push_back(centre);
    for (std::uint32_t i = 0; i < corners; ++i) {
        const T angle = T(2) * pi<T> * T(i) / T(corners);
        mesh.positions.push_back(centre + radius * std::cos(angle) * frame.u + radius * std::sin(angle) * frame.v);
        mesh.triangles.push_back({first, first + 1 + i, first + 1 + (i + 1) % corners});
        mesh.materials.push_back(material);
    }
}

} // namespace nephroid::examples::detail
