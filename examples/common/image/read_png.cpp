// SPDX-License-Identifier: MIT
#include "common/image/read_png.hpp"

#include "common/image/decode.hpp"

#include <cmath>

namespace nephroid::examples {

namespace {

/// The inverse of `srgb_from_linear`. Source: IEC 61966-2-1.
[[nodiscard]] float linear_from_srgb(double encoded) {
    return static_cast<float>(encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4));
}

} // namespace

Image<Rgb> read_png(const std::filesystem::path& path) {
    const Decoded16 image = read_16_bits(path);
    Image<Rgb> picture(image.width, image.height);
    for (std::size_t y = 0; y < picture.height; ++y)
        for (std::size_t x = 0; x < picture.width; ++x)
            for (std::size_t channel = 0; channel < 3; ++channel) {
                const std::size_t top_down = picture.height - 1 - y;
                picture(x, y)[channel] =
                    linear_from_srgb(image.rgb[(top_down * picture.width + x) * 3 + channel] / 65535.0);
            }
    return picture;
}

Image<float> brightness(const Image<Rgb>& picture) {
    Image<float> grey(picture.width, picture.height);
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        const auto& [red, green, blue] = picture.pixels[i];
        grey.pixels[i] = 0.2126f * red + 0.7152f * green + 0.0722f * blue;
    }
    return grey;
}

} // namespace nephroid::examples
