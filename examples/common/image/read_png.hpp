// SPDX-License-Identifier: MIT
/// @file  Reads a PNG as linear light.
#pragma once

#include "common/image/image.hpp"

#include <filesystem>

namespace nephroid::examples {

/// Reads a .png of 8 or 16 bits per channel, decoded from sRGB; grey becomes three equal channels, transparency is
/// ignored. Row 0 is the bottom one.
/// Throws std::runtime_error, one line with the path and the reason.
[[nodiscard]] Image<Rgb> read_png(const std::filesystem::path& path);

/// The luminance of every pixel, by the weights of ITU-R BT.709.
[[nodiscard]] Image<float> brightness(const Image<Rgb>& picture);

} // namespace nephroid::examples
