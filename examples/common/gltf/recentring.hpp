// SPDX-License-Identifier: MIT
/// @file  Where a scene that lies far from the origin is moved from.
#pragma once

#include "common/gltf.hpp"
#include "common/gltf/tinygltf.hpp"

#include <glm/vec3.hpp>

#include <cstddef>
#include <vector>

namespace nephroid::examples::gltf {

/// The point that becomes the origin: about the middle of what is specular (else of all meshes), or 0 where that lies
/// within 16 of its radii of the origin already, which costs float one digit.
///
/// A float has 24 bits. A glass of radius 1 that stands 10,000 from the origin has its surface on a grid of 0.001, and
/// its caustic is noise; moved before its vertices become floats it is what it is at the origin.
///
/// @param file_bytes  what the instances' memory must be in proportion to
[[nodiscard]] glm::dvec3 origin_for(const tinygltf::Model& model, const std::vector<std::size_t>& roots,
                                    const std::vector<MaterialDescription>& materials, std::size_t file_bytes);

} // namespace nephroid::examples::gltf
