// SPDX-License-Identifier: MIT
/// @file  The instances of a node's mesh: one, or those of EXT_mesh_gpu_instancing.
#pragma once

#include "common/gltf/report.hpp"
#include "common/gltf/tinygltf.hpp"

#include <glm/mat4x4.hpp>

#include <string_view>
#include <vector>

namespace nephroid::examples::gltf {

/// The transforms of a node's instances in the node's own space; the identity without the extension.
/// Fails for attributes that differ in number, are of another type, or are not finite.
[[nodiscard]] std::vector<glm::dmat4> instances_of(const tinygltf::Model& model, const tinygltf::Node& node,
                                                   std::string_view name, Budget& budget);

} // namespace nephroid::examples::gltf
