// SPDX-License-Identifier: MIT
/// @file  OpenEXR: 32-bit floats, compressed without loss.
#pragma once

#include "common/image/image.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace nephroid::examples {

/// Whether this build has OpenEXR (the build defines `NEPHROID_EXAMPLES_HAS_OPENEXR` for exr.cpp).
[[nodiscard]] bool has_openexr();

/// Refuses to write `path` in a build without OpenEXR: throws std::runtime_error that says so.
void require_openexr(const std::filesystem::path& path);

/// Writes a channel Y (grey) or channels R, G, B (colour), samples unchanged, the top row first as the format asks.
///
/// Throws std::invalid_argument for an image that is empty, not finite or too large for the format, std::runtime_error
/// for a build without OpenEXR or a file that cannot be written, of which then nothing is left behind.
void write_exr(const std::filesystem::path& path, const Samples& image);

/// A picture within a file of several.
struct ExrLayer {
    std::string name; ///< its channels are NAME.R, NAME.G and NAME.B or NAME.Y, or R, G, B or Y without a name
    Samples picture;
};

/// Writes pictures of one size into one file. Throws as `write_exr` does, and std::invalid_argument for pictures of
/// different sizes.
void write_exr_layers(const std::filesystem::path& path, const std::vector<ExrLayer>& layers);

/// Reads the channels R, G and B, or Y alone. Row 0 is the bottom one.
/// Throws std::runtime_error, one line with the path and the reason, also for a build without OpenEXR.
[[nodiscard]] Samples read_exr(const std::filesystem::path& path);

} // namespace nephroid::examples
