// SPDX-License-Identifier: MIT
#include "common/image/decode.hpp"

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

namespace {

/// What one allocation of stb_image may ask for at most: zlib can make a thousand bytes of one, and stb_image unpacks
/// them all, also those that no pixel needs.
struct AllocationLimit {
    std::size_t bytes = std::numeric_limits<std::size_t>::max();
    bool was_exceeded = false;

    [[nodiscard]] bool allows(std::size_t size) {
        was_exceeded = was_exceeded || size > bytes;
        return size <= bytes;
    }
};
thread_local AllocationLimit allocation_limit;

[[maybe_unused]] void* allocate_within_limit(std::size_t size) {
    return allocation_limit.allows(size) ? std::malloc(size) : nullptr;
}
[[maybe_unused]] void* reallocate_within_limit(void* old, std::size_t size) {
    return allocation_limit.allows(size) ? std::realloc(old, size) : nullptr;
}

} // namespace

#define STBI_MALLOC(size) allocate_within_limit(size)
#define STBI_REALLOC(old, size) reallocate_within_limit(old, size)
#define STBI_FREE(old) std::free(old)
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
    if (stbi_is_hdr_from_memory(file.data(), size_of(file)) != 0) // which is for light from all around
        return 0;
    if (stbi_info_from_memory(file.data(), size_of(file), &width, &height, &channels) == 0)
        return 0;
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

DecodedImage decode_image(std::span<const unsigned char> file) {
    const std::size_t pixels = pixels_of_image(file);
    int width = 0, height = 0, channels = 0;
    if (pixels == 0 || stbi_info_from_memory(file.data(), size_of(file), &width, &height, &channels) == 0)
        throw std::runtime_error("neither PNG nor JPEG that can be read");
    const std::string size = std::to_string(width) + " x " + std::to_string(height);
    // 16 bytes a pixel: twice four channels of 16 bits, as buffers grow by doubling; twice the file, likewise; and
    // 1 MiB for the decoder's tables and the borders of tiny images.
    allocation_limit = {16 * pixels + 2 * file.size() + (std::size_t{1} << 20), false};
    const std::unique_ptr<stbi_uc, void (*)(void*)> samples(
        stbi_load_from_memory(file.data(), size_of(file), &width, &height, &channels, 4), stbi_image_free);
    const bool is_too_large = std::exchange(allocation_limit, AllocationLimit()).was_exceeded;
    if (!samples && is_too_large)
        throw std::runtime_error("its data unpacks to far more than its " + size + " pixels need");
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
