// SPDX-License-Identifier: MIT
/// @file  Reads a picture of an environment.
#pragma once

#include "common/image/image.hpp"

#include <filesystem>

namespace nephroid::examples {

/// Reads a .hdr, .exr, .pfm or .png (decoded from sRGB) as linear light, three channels or one. Row 0 is the bottom.
/// Throws std::runtime_error, one line with the path and the reason, also for another extension, and for .exr in a
/// build without OpenEXR.
[[nodiscard]] Samples read_environment(const std::filesystem::path& path);

} // namespace nephroid::examples
