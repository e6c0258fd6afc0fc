// SPDX-License-Identifier: MIT
/// @file  The materials of a glTF file: its metallic-roughness model and the extensions for glass.
#pragma once

#include "common/gltf.hpp"
#include "common/gltf/report.hpp"
#include "common/gltf/texture.hpp"
#include "common/gltf/tinygltf.hpp"

#include <cstddef>

namespace nephroid::examples::gltf {

/// Reads a material and its textures. Factors just outside of their range are moved into it, with a warning.
///
/// Fails for a value that has no meaning, such as an index of refraction of 0.5.
[[nodiscard]] MaterialDescription read_material(const tinygltf::Material& material, std::size_t index,
                                                TextureReader& textures, Warnings& warnings);

} // namespace nephroid::examples::gltf
