// SPDX-License-Identifier: MIT
/// @file  The encoded images of a glTF file: in a buffer, in a data URI, or in a file beside it.
#pragma once

#include "common/gltf/tinygltf.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace nephroid::examples::gltf {

struct ImageBytes {
    std::vector<unsigned char> bytes;
    std::string name;             ///< of the image for messages: its URI or its type
    std::filesystem::path file{}; ///< beside the scene's; empty for an image inside it
};

/// tinygltf reads no image here, because it would read all: prepare_json has renamed the file's "images" to "extras",
/// which tinygltf keeps as they are.
[[nodiscard]] std::size_t image_count(const tinygltf::Model& model);

/// Throws std::runtime_error with a short reason.
///
/// @param image   less than `image_count`
/// @param folder  of the glTF file
[[nodiscard]] ImageBytes bytes_of_image(const tinygltf::Model& model, std::size_t image,
                                        const std::filesystem::path& folder);

} // namespace nephroid::examples::gltf
