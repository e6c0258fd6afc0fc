// SPDX-License-Identifier: MIT
/// @file  The nodes of a glTF scene: where they begin, and a walk over them with their transforms.
#pragma once

#include "common/gltf/tinygltf.hpp"

#include <glm/mat4x4.hpp>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace nephroid::examples::gltf {

/// The nodes that the scene starts from, each once. Fails unless all nodes of the file form trees, as glTF demands:
/// then no walk is endless.
[[nodiscard]] std::vector<std::size_t> roots_of(const tinygltf::Model& model);

/// What is done with a node: `name` is for messages.
using VisitNode = std::function<void(const tinygltf::Node& node, const std::string& name, const glm::dmat4& to_world)>;

/// Visits a node before its children, and children in their order.
///
/// @param start  the transform of the roots' own space
void for_each_node(const tinygltf::Model& model, const std::vector<std::size_t>& roots, const glm::dmat4& start,
                   const VisitNode& visit);

} // namespace nephroid::examples::gltf
