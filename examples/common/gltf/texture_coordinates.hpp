// SPDX-License-Identifier: MIT
/// @file  Texture coordinates and tangents of one primitive of a glTF mesh.
#pragma once

#include "common/gltf.hpp"
#include "common/gltf/report.hpp"
#include "common/gltf/tinygltf.hpp"

#include <glm/mat4x4.hpp>

#include <string_view>

namespace nephroid::examples::gltf {

/// Reads the texture coordinates that a material uses. If it has a normal map, also the tangents of the file, or else
/// computes them from the coordinates; a vertex where the image meets its mirror image then becomes two.
///
/// @param mesh   with its positions, triangles and normals
/// @param owner  such as `mesh 3 ("sphere")`, for messages
void read_texture_coordinates(MeshDescription& mesh, const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                              const MaterialDescription& material, const glm::dmat4& to_world, std::string_view owner,
                              Budget& budget, Warnings& warnings);

} // namespace nephroid::examples::gltf
