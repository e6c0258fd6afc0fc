// SPDX-License-Identifier: MIT
/// @file  Finds the new origin of a scene that is far from the old one.
#pragma once

#include "common/gltf.hpp"
#include "common/gltf/tinygltf.hpp"

#include <glm/vec3.hpp>

#include <cstddef>
#include <vector>

namespace nephroid::examples::gltf {

/// The point that becomes the origin: roughly the middle of the specular surfaces, or of all meshes if none is
/// specular; 0 if the middle is within 16 radii of the origin, which costs one digit of a float.
///
/// A float has 24 bits. The surface of a glass of radius 1 at a distance of 10,000 from the origin is on a grid of
/// 0.001, and its caustic is noise. If it is moved before its vertices become floats, the caustic is as good as at the
/// origin.
///
/// @param file_bytes  size of the file, to which the memory of instances must be in proportion
[[nodiscard]] glm::dvec3 origin_for(const tinygltf::Model& model, const std::vector<std::size_t>& roots,
                                    const std::vector<MaterialDescription>& materials, std::size_t file_bytes);

} // namespace nephroid::examples::gltf
