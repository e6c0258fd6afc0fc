// SPDX-License-Identifier: MIT
/// @file  Pictures for the tests of the quality measures: reproducible anywhere, by integer arithmetic alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace nephroid::tests {

/// Noise in {0, 1/256, ..., 255/256}, exact in float, uncorrelated between pixels; the same for the same seed.
[[nodiscard]] inline std::vector<float> noise_picture(std::size_t width, std::size_t height, std::uint32_t seed) {
    std::vector<float> picture(width * height);
    std::uint32_t state = seed;
    for (float& pixel : picture) {
        state = state * 1664525u + 1013904223u;
        pixel = static_cast<float>(state >> 24) / 256;
    }
    return picture;
}

} // namespace nephroid::tests
