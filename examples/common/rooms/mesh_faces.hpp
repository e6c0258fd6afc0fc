// SPDX-License-Identifier: MIT
/// @file  Builds meshes of flat faces: quadrilaterals and blocks.
#pragma once

#include "common/shapes/mesh_data.hpp"

#include <cstdint>

namespace nephroid::examples {

/// Adds two triangles.
///
/// @param a,b,c,d  the corners, counter-clockwise seen from the front. Faces that share corners have no gap between
template <class T>
void add_face(MeshData<T>& mesh, const Vec3<T>& a, const Vec3<T>& b, const Vec3<T>& c, const Vec3<T>& d,
              std::uint32_t material) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const Vec3<T>& corner : {a, b, c, d})
        mesh.positions.push_back(corner);
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
    mesh.materials.insert(mesh.materials.end(), 2, material);
}

/// Adds the faces of a box, y up, that are seen from outside.
///
/// @param has_bottom  not for a block that stands on a floor
template <class T>
void add_block(MeshData<T>& mesh, const Box<T>& box, std::uint32_t material, bool has_bottom = true) {
    const auto at = [&](int x, int y, int z) { return box.corner(x | y << 1 | z << 2); };
    add_face(mesh, at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0), material);
    add_face(mesh, at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1), material);
    add_face(mesh, at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0), material);
    add_face(mesh, at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1), material);
    add_face(mesh, at(0, 1, 0), at(0, 1, 1), at(1, 1, 1), at(1, 1, 0), material);
    if (has_bottom)
        add_face(mesh, at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1), material);
}

/// The materials of a room's surfaces, as seen from inside.
struct RoomMaterials {
    std::uint32_t x_min, x_max, floor, ceiling, z_min, z_max;

    /// The same everywhere.
    [[nodiscard]] static RoomMaterials all(std::uint32_t material) {
        return {material, material, material, material, material, material};
    }
};

/// Adds the walls, the floor and the ceiling of a box-shaped room, y up; a part of the ceiling may be a lamp's.
///
/// @param lamp      its x and z lie within the room's, its y is ignored; empty: there is none
/// @param lamp_material  of that part
template <class T>
void add_room(MeshData<T>& mesh, const Box<T>& box, const RoomMaterials& materials, const Box<T>& lamp = {},
              std::uint32_t lamp_material = 0) {
    const auto at = [&](int x, int y, int z) { return box.corner(x | y << 1 | z << 2); };
    add_face(mesh, at(0, 0, 0), at(0, 1, 0), at(0, 1, 1), at(0, 0, 1), materials.x_min);
    add_face(mesh, at(1, 0, 0), at(1, 0, 1), at(1, 1, 1), at(1, 1, 0), materials.x_max);
    add_face(mesh, at(0, 0, 0), at(0, 0, 1), at(1, 0, 1), at(1, 0, 0), materials.floor);
    add_face(mesh, at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0), materials.z_min);
    add_face(mesh, at(0, 0, 1), at(0, 1, 1), at(1, 1, 1), at(1, 0, 1), materials.z_max);
    if (lamp.is_empty()) {
        add_face(mesh, at(0, 1, 0), at(1, 1, 0), at(1, 1, 1), at(0, 1, 1), materials.ceiling);
        return;
    }
    const T x[] = {box.min.x, lamp.min.x, lamp.max.x, box.max.x}, z[] = {box.min.z, lamp.min.z, lamp.max.z, box.max.z};
    const auto above = [&](int i, int j) { return Vec3<T>(x[i], box.max.y, z[j]); };
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            add_face(mesh, above(i, j), above(i + 1, j), above(i + 1, j + 1), above(i, j + 1),
                     i == 1 && j == 1 ? lamp_material : materials.ceiling);
}

} // namespace nephroid::examples
