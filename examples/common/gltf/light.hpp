// SPDX-License-Identifier: MIT
/// @file  Reads a glTF node's light (KHR_lights_punctual) or camera.
#pragma once

#include "common/gltf.hpp"
#include "common/gltf/tinygltf.hpp"

#include <glm/mat4x4.hpp>

#include <optional>
#include <string_view>

namespace nephroid::examples::gltf {

/// The node's light, if it has one. A scale of the node has no effect on it.
///
/// @param node_name  for messages. Fails for an unknown type, a negative intensity, cones that are no cones
[[nodiscard]] std::optional<LightDescription> light_of(const tinygltf::Model& model, const tinygltf::Node& node,
                                                       const glm::dmat4& to_world, std::string_view node_name);

/// The node's camera, if it has one. A scale of the node has no effect on it, nor has a mirroring one.
///
/// Fails for angles and sizes that are out of range.
[[nodiscard]] std::optional<CameraDescription> camera_of(const tinygltf::Model& model, const tinygltf::Node& node,
                                                         const glm::dmat4& to_world, std::string_view node_name);

} // namespace nephroid::examples::gltf
