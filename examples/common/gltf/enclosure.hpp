// SPDX-License-Identifier: MIT
/// @file  Whether a mesh encloses a volume, and which way its triangles face.
#pragma once

#include "common/gltf.hpp"

namespace nephroid::examples::gltf {

struct Enclosure {
    bool is_closed = false; ///< each edge has a triangle on either side that goes along it the other way
    double volume = 0;      ///< of a closed mesh, world units cubed; negative where its triangles face inwards
};

/// Vertices at one place count as one, as they are split where texture coordinates or normals are.
[[nodiscard]] Enclosure enclosure_of(const MeshDescription& mesh);

} // namespace nephroid::examples::gltf
