// SPDX-License-Identifier: MIT
/// @file  PNG for viewing: 8 bits per channel, exposed, clipped, sRGB-encoded.
#pragma once

#include "common/image/image.hpp"

#include <filesystem>

namespace nephroid::examples {

/// Writes clip(exposure * sample, 0, 1), sRGB-encoded and rounded to 8 bits; grey stays grey; the top row first.
///
/// @param exposure  > 0, finite; `nephroid::picture_exposure` of a reference makes a good one
/// Throws std::invalid_argument for a bad exposure or an image that is empty, not finite or too large for the format,
/// std::runtime_error for a file that cannot be written, of which then nothing is left behind.
void write_png(const std::filesystem::path& path, const Samples& image, double exposure = 1);

/// The sRGB transfer function of IEC 61966-2-1.
///
/// @param linear  in [0, 1]
/// @return  in [0, 1], about the 1/2.2th power
[[nodiscard]] double srgb_from_linear(double linear);

} // namespace nephroid::examples
