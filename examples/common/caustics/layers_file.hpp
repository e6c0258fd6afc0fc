// SPDX-License-Identifier: MIT
/// @file  All layers of a picture in one .exr.
#pragma once

#include "common/caustics/builtin.hpp"

#include <filesystem>

namespace nephroid::examples {

/// Writes the picture as channels R, G and B (or Y), each layer as NAME.R, NAME.G and NAME.B (or NAME.Y), and where
/// there were several passes the variance of a pixel's mean over its channels as NAME.variance.Y. Throws as
/// `write_exr_layers`.
void write_layers(const std::filesystem::path& path, const Rendering& rendering);

} // namespace nephroid::examples
