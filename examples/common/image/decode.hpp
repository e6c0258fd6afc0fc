// SPDX-License-Identifier: MIT
/// @file  Reads images in common formats: the textures of glTF files, and Radiance's .hdr.
#pragma once

#include "common/image/image.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace nephroid::examples {

/// Red, green, blue and opacity, 8 bits each, as the file has them; row 0 at the *top*, as glTF's coordinates have it.
struct DecodedImage {
    std::size_t width = 0, height = 0;
    std::vector<std::uint8_t> rgba;
};

/// Red, green and blue, 16 bits each; row 0 at the top.
struct Decoded16 {
    std::size_t width = 0, height = 0;
    std::vector<std::uint16_t> rgb;
};

/// Pixels of a PNG or JPEG in memory, from its header alone; 0 for other files.
[[nodiscard]] std::size_t pixels_of_image(std::span<const unsigned char> file);

/// Decodes a PNG or JPEG. Uses at most 24 bytes a pixel, three times the file and a few MiB, also for a broken file.
///
/// Throws std::runtime_error with a short reason for other files.
[[nodiscard]] DecodedImage decode_image(std::span<const unsigned char> file);

/// Reads a PNG of 8 or 16 bits per channel. Throws std::runtime_error, one line with the path and the reason.
[[nodiscard]] Decoded16 read_16_bits(const std::filesystem::path& path);

/// Reads Radiance's .hdr. Throws std::runtime_error, one line with the path and the reason.
[[nodiscard]] Samples read_hdr(const std::filesystem::path& path);

} // namespace nephroid::examples
