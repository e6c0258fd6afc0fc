// SPDX-License-Identifier: MIT
/// @file  Whether a mesh encloses a volume, and which way its triangles face.
#pragma once

#include "common/gltf.hpp"

namespace nephroid::examples::gltf {

struct Enclosure {
    bool is_closed = false; ///< each edge belongs to two triangles, which traverse it in opposite directions
    double volume = 0;      ///< of a closed mesh, world units cubed; negative where its triangles face inwards
};

/// Vertices at one position, to a few roundings of float, count as one, because files split them where texture
/// coordinates or normals differ.
[[nodiscard]] Enclosure enclosure_of(const MeshDescription& mesh);

} // namespace nephroid::examples::gltf
