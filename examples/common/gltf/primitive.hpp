// SPDX-License-Identifier: MIT
/// @file  One primitive of a glTF mesh in world space.
#pragma once

#include "common/gltf.hpp"
#include "common/gltf/report.hpp"
#include "common/gltf/tinygltf.hpp"

#include <glm/mat4x4.hpp>

#include <optional>
#include <string_view>

namespace nephroid::examples::gltf {

/// Reads positions, normals, triangles, and what the material's textures need; the caller adds name and material.
///
/// @param owner     such as `mesh 3 ("sphere")`, for messages
/// @param material  of the primitive
/// @return  nothing, with a warning, for points, lines, and where no triangle has an area
[[nodiscard]] std::optional<MeshDescription>
read_primitive(const tinygltf::Model& model, const tinygltf::Primitive& primitive, const glm::dmat4& to_world,
               std::string_view owner, const MaterialDescription& material, Budget& budget, Warnings& warnings);

} // namespace nephroid::examples::gltf
