// SPDX-License-Identifier: MIT
/// @file  Parses a file into tinygltf's model, which is then complete, but not checked for consistency.
#pragma once

#include "common/gltf/report.hpp"
#include "common/gltf/tinygltf.hpp"

#include <filesystem>
#include <span>

namespace nephroid::examples::gltf {

/// Parses a .glb or .gltf, and reads its buffers, but no images.
///
/// @param folder  where buffers that are files of their own are looked for
/// Fails if it is broken, truncated, of another version, or requires an extension that is not read.
[[nodiscard]] tinygltf::Model load_model(std::span<const unsigned char> file, const std::filesystem::path& folder,
                                         Warnings& warnings);

} // namespace nephroid::examples::gltf
