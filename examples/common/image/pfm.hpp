// SPDX-License-Identifier: MIT
/// @file  PFM, the portable float map: a text header and raw 32-bit floats. Exact, and read by most HDR viewers.
#pragma once

#include "common/image/image.hpp"

#include <filesystem>

namespace nephroid::examples {

/// Writes "Pf" (grey) or "PF" (colour), little endian, the bottom row first as the format asks, samples unchanged.
///
/// Throws std::invalid_argument for an image that is empty or not finite, std::runtime_error for a file that cannot be
/// written, of which then nothing is left behind.
void write_pfm(const std::filesystem::path& path, const Samples& image);

/// Reads "Pf" or "PF" of either byte order; samples are multiplied by the magnitude of the header's scale.
///
/// @return  row 0 at the bottom. Samples that are not finite are passed on, as comparing tools must see them
/// Throws std::runtime_error with the path and what is wrong: no such file, no PFM header, too short, too long.
[[nodiscard]] Samples read_pfm(const std::filesystem::path& path);

} // namespace nephroid::examples
