// SPDX-License-Identifier: MIT
/// @file  The exposure of a picture of a room, in which lamps and caustics are far brighter than walls.
#pragma once

#include "common/image/image.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace nephroid::examples {

/// The exposure at which nine in ten of the pixels that are not black are below 0.7: caustics may be clipped, not
/// walls.
///
/// @param picture  of three bands
[[nodiscard]] inline double room_exposure(const Samples& picture) {
    std::vector<double> brightness;
    for (std::size_t i = 0; i + 2 < picture.samples.size(); i += 3) {
        const float* const pixel = picture.samples.data() + i;
        if (const double b = (double(pixel[0]) + double(pixel[1]) + double(pixel[2])) / 3; b > 0)
            brightness.push_back(b);
    }
    if (brightness.empty())
        return 1;
    const auto bright = brightness.begin() + static_cast<std::ptrdiff_t>(brightness.size() * 9 / 10);
    std::nth_element(brightness.begin(), bright, brightness.end());
    return 0.7 / *bright;
}

} // namespace nephroid::examples
