// SPDX-License-Identifier: MIT
/// @file  Writes an image in the format given by the file's extension.
#pragma once

#include "common/image/image.hpp"

#include <filesystem>

namespace nephroid::examples {

/// Writes .exr, .pfm (exact, linear) or .png (for viewing); the extension's case does not matter.
///
/// @param exposure  of a .png, see `write_png`; the other formats keep the samples as they are
/// Throws std::invalid_argument for an unknown extension or an image that is empty or not finite, std::runtime_error
/// for a build without OpenEXR or a file that cannot be written, of which then nothing is left behind.
void write_image(const std::filesystem::path& path, const Samples& image, double exposure = 1);

/// Checks before a long render whether `write_image` can write to `path`. It cannot for an unknown extension, .exr
/// in a build without OpenEXR, no such folder, no permission. Leaves no file behind; throws what `write_image` would.
void require_writable_image(const std::filesystem::path& path);

} // namespace nephroid::examples
