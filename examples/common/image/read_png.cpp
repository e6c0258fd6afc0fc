// SPDX-License-Identifier: MIT
#include "common/image/read_png.hpp"

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
#elif defined(_MSC_VER)
#pragma warning(push, 0)
#endif
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC // tinygltf may bring its own copy
#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#if __has_include(<stb/stb_image.h>)
#include <stb/stb_image.h>
#else
#include <stb_image.h>
#endif
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#elif defined(_MSC_VER)
#pragma warning(pop)
#endif

namespace nephroid::examples {

namespace {

/// The inverse of `srgb_from_linear`. Source: IEC 61966-2-1.
[[nodiscard]] float linear_from_srgb(double encoded) {
    return static_cast<float>(encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4));
}

[[nodiscard]] std::vector<unsigned char> bytes_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file)
        throw std::runtime_error("cannot read '" + path.string() + "'");
    std::vector<unsigned char> bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
        throw std::runtime_error("'" + path.string() + "' is larger than 2 GB");
    return bytes;
}

} // namespace

Image<Rgb> read_png(const std::filesystem::path& path) {
    const std::vector<unsigned char> bytes = bytes_of(path);
    int width = 0, height = 0, channels = 0;
    const std::unique_ptr<stbi_us, void (*)(void*)> samples(
        stbi_load_16_from_memory(bytes.data(), static_cast<int>(bytes.size()), &width, &height, &channels, 3),
        stbi_image_free);
    if (!samples)
        throw std::runtime_error("'" + path.string() + "' is no PNG that can be read: " + stbi_failure_reason());
    Image<Rgb> picture(static_cast<std::size_t>(width), static_cast<std::size_t>(height));
    for (std::size_t y = 0; y < picture.height; ++y)
        for (std::size_t x = 0; x < picture.width; ++x)
            for (std::size_t channel = 0; channel < 3; ++channel) {
                const std::size_t top_down = picture.height - 1 - y;
                picture(x, y)[channel] =
                    linear_from_srgb(samples.get()[(top_down * picture.width + x) * 3 + channel] / 65535.0);
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
