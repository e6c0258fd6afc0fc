// SPDX-License-Identifier: MIT
/// @file  The transforms of nodes, in double precision, so that deep hierarchies stay exact in float.
#pragma once

#include "common/gltf/tinygltf.hpp"

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <string_view>

namespace nephroid::examples::gltf {

/// The affine map of a node to its parent's space, from its matrix or from translation, rotation and scale.
///
/// Fails if something in it is not finite in float, has the wrong number of entries, or is not affine.
[[nodiscard]] glm::dmat4 local_transform(const tinygltf::Node& node, std::string_view name);

/// The matrix for normals, which are normalised afterwards: the transposed inverse up to a positive factor, even if
/// there is no inverse. `mirrored` says whether the transform contains a reflection.
struct NormalTransform {
    glm::dmat3 matrix;
    bool mirrored;
};
[[nodiscard]] NormalTransform normal_transform(const glm::dmat4& to_world);

[[nodiscard]] bool is_finite(const glm::dvec3& v);
/// Whether every entry is finite, also after conversion to float.
[[nodiscard]] bool is_finite_in_float(const glm::dmat4& m);

/// Converts a number of the file, which fails where it is not finite in float.
[[nodiscard]] float to_float(double value, std::string_view owner, std::string_view property);

} // namespace nephroid::examples::gltf
