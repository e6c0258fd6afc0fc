// SPDX-License-Identifier: MIT
#include "common/image/decode.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC // tinygltf may bring its own copy
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_HDR
#define STBI_NO_STDIO
#if __has_include(<stb/stb_image.h>)
#include <stb/stb_image.h>
#else
#include <stb_image.h>
#endif

namespace nephroid::examples {

namespace {

[[nodiscard]] int size_of(std::span<const unsigned char> file) {
    if (file.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
        throw std::runtime_error("larger than 2 GB");
    return static_cast<int>(file.size());
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

std::size_t pixels_of_image(std::span<const unsigned char> file) {
    int width = 0, height = 0, channels = 0;
    if (stbi_info_from_memory(file.data(), size_of(file), &width, &height, &channels) == 0)
        return 0;
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

DecodedImage decode_image(std::span<const unsigned char> file) {
    int width = 0, height = 0, channels = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> samples(
        stbi_load_from_memory(file.data(), size_of(file), &width, &height, &channels, 4), stbi_image_free);
    if (!samples)
        throw std::runtime_error(std::string("neither PNG nor JPEG that can be read: ") + stbi_failure_reason());
    DecodedImage image{static_cast<std::size_t>(width), static_cast<std::size_t>(height), {}};
    image.rgba.assign(samples.get(), samples.get() + 4 * image.width * image.height);
    return image;
}

Decoded16 read_16_bits(const std::filesystem::path& path) {
    const std::vector<unsigned char> bytes = bytes_of(path);
    int width = 0, height = 0, channels = 0;
    const std::unique_ptr<stbi_us, void (*)(void*)> samples(
        stbi_load_16_from_memory(bytes.data(), size_of(bytes), &width, &height, &channels, 3), stbi_image_free);
    if (!samples)
        throw std::runtime_error("'" + path.string() + "' is no PNG that can be read: " + stbi_failure_reason());
    Decoded16 image{static_cast<std::size_t>(width), static_cast<std::size_t>(height), {}};
    image.rgb.assign(samples.get(), samples.get() + 3 * image.width * image.height);
    return image;
}

Samples read_hdr(const std::filesystem::path& path) {
    const std::vector<unsigned char> bytes = bytes_of(path);
    if (stbi_is_hdr_from_memory(bytes.data(), size_of(bytes)) == 0)
        throw std::runtime_error("'" + path.string() + "' is no Radiance picture (.hdr)");
    int width = 0, height = 0, channels = 0;
    const std::unique_ptr<float, void (*)(void*)> samples(
        stbi_loadf_from_memory(bytes.data(), size_of(bytes), &width, &height, &channels, 3), stbi_image_free);
    if (!samples)
        throw std::runtime_error("'" + path.string() + "' is no .hdr that can be read: " + stbi_failure_reason());
    Samples picture(static_cast<std::size_t>(width), static_cast<std::size_t>(height), 3, {});
    const std::size_t row = 3 * picture.width;
    for (std::size_t y = picture.height; y-- > 0;) // .hdr files have the top row first
        picture.samples.insert(picture.samples.end(), samples.get() + y * row, samples.get() + (y + 1) * row);
    return picture;
}

} // namespace nephroid::examples
