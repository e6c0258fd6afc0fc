// SPDX-License-Identifier: MIT
/// @file  Reads accessors: typed, strided, sparse arrays in the buffers of a glTF file.
#pragma once

#include "common/gltf/tinygltf.hpp"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace nephroid::examples::gltf {

/// An accessor that is known to lie within its buffer.
struct AccessorView {
    const tinygltf::Accessor* accessor = nullptr;
    std::size_t index = 0;
    std::size_t count = 0; ///< elements, >= 1. Without a buffer view, which is legal, any number whatsoever
    const unsigned char* data = nullptr; ///< of the first element; null: all elements are zero
    std::size_t stride = 0;              ///< bytes from one element to the next
};

/// The bytes of a buffer view, known to lie within its buffer, such as an image.
///
/// @param index  as the file has it; @param owner  of the index, for messages
std::vector<unsigned char> bytes_of_view(const tinygltf::Model& model, int index, std::string_view owner);

/// Finds an accessor and checks its type, its component type and its bounds, those of its sparse part included.
///
/// @param index       as the file has it; @param owner  of the index, for messages
/// @param components  of each vector, 2 to 4
AccessorView view_vectors(const tinygltf::Model& model, int index, std::string_view owner, int components = 3);

/// The same for an accessor of indices: unsigned scalars.
AccessorView view_indices(const tinygltf::Model& model, int index, std::string_view owner);

/// All elements of what `view_vectors` found: floats as they are, integers converted or normalized as glTF says.
std::vector<glm::vec3> read_vectors(const tinygltf::Model& model, const AccessorView& view);
std::vector<glm::vec2> read_pairs(const tinygltf::Model& model, const AccessorView& view);
std::vector<glm::vec4> read_quadruples(const tinygltf::Model& model, const AccessorView& view);

/// All elements of what `view_indices` found.
std::vector<std::uint32_t> read_indices(const tinygltf::Model& model, const AccessorView& view);

} // namespace nephroid::examples::gltf
