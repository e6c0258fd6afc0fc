// SPDX-License-Identifier: MIT
/// @file  What a glTF node can hold besides meshes: a light of KHR_lights_punctual, a camera.
#pragma once

#include "common/gltf.hpp"
#include "common/gltf/tinygltf.hpp"

#include <glm/mat4x4.hpp>

#include <optional>
#include <string_view>

namespace nephroid::examples::gltf {

/// The light that the node shows, where it does. A scale of the node has no effect on it.
///
/// @param node_name  for messages. Fails for an unknown type, a negative intensity, cones that are no cones
[[nodiscard]] std::optional<LightDescription> light_of(const tinygltf::Model& model, const tinygltf::Node& node,
                                                       const glm::dmat4& to_world, std::string_view node_name);

/// The camera that the node shows, where it does. A scale of the node has no effect on it, nor has a mirroring one.
///
/// Fails for angles and sizes that are out of range.
[[nodiscard]] std::optional<CameraDescription> camera_of(const tinygltf::Model& model, const tinygltf::Node& node,
                                                         const glm::dmat4& to_world, std::string_view node_name);

} // namespace nephroid::examples::gltf
