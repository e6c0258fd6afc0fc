// SPDX-License-Identifier: MIT
/// @file  The nodes of a glTF scene: its roots, and a walk over all nodes with their transforms.
#pragma once

#include "common/gltf/tinygltf.hpp"

#include <glm/mat4x4.hpp>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace nephroid::examples::gltf {

/// The scene's root nodes, each once. Fails unless all nodes of the file form trees, as glTF demands, so that every
/// walk ends.
[[nodiscard]] std::vector<std::size_t> roots_of(const tinygltf::Model& model);

/// A function that visits a node; `name` is for messages.
using VisitNode = std::function<void(const tinygltf::Node& node, const std::string& name, const glm::dmat4& to_world)>;

/// Visits a node before its children, and children in their order.
///
/// @param start  the transform of the roots' own space
void for_each_node(const tinygltf::Model& model, const std::vector<std::size_t>& roots, const glm::dmat4& start,
                   const VisitNode& visit);

} // namespace nephroid::examples::gltf
