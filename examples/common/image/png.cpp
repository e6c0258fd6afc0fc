// SPDX-License-Identifier: MIT
#include "common/image/png.hpp"

#include "common/image/file.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC // tinygltf may bring its own copy
#define STBI_WRITE_NO_STDIO
#if __has_include(<stb/stb_image_write.h>)
#include <stb/stb_image_write.h>
#else
#include <stb_image_write.h>
#endif

namespace nephroid::examples {

double srgb_from_linear(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

void write_png(const std::filesystem::path& path, const Samples& image, double exposure) {
    require_writable_samples("write_png", image);
    if (!(exposure > 0) || !std::isfinite(exposure))
        throw std::invalid_argument("write_png: exposure is " + std::to_string(exposure) +
                                    ", it must be positive and finite");
    // stb computes the size of the uncompressed file, a filter byte per row included, and twice that, in int.
    const std::size_t row = image.width * image.channels;
    constexpr std::size_t largest = std::numeric_limits<int>::max() / 2;
    if (row >= largest || image.height > largest / (row + 1))
        throw std::invalid_argument("write_png: an image of " + std::to_string(image.width) + " x " +
                                    std::to_string(image.height) + " is too large for this PNG encoder");

    std::vector<unsigned char> encoded(image.samples.size());
    for (std::size_t y = 0; y < image.height; ++y)
        for (std::size_t i = 0; i < row; ++i) {
            const double linear = std::clamp(exposure * static_cast<double>(image.samples[y * row + i]), 0.0, 1.0);
            const std::size_t top_down = image.height - 1 - y;
            encoded[top_down * row + i] = static_cast<unsigned char>(std::lround(255 * srgb_from_linear(linear)));
        }

    std::string bytes;
    const auto append = [](void* context, void* data, int size) {
        static_cast<std::string*>(context)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
    };
    const int written =
        stbi_write_png_to_func(append, &bytes, static_cast<int>(image.width), static_cast<int>(image.height),
                               static_cast<int>(image.channels), encoded.data(), static_cast<int>(row));
    if (written == 0)
        throw std::runtime_error("cannot write '" + path.string() + "': the PNG encoder ran out of memory");
    write_file(path, bytes);
}

} // namespace nephroid::examples
