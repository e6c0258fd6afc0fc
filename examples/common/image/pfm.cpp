// SPDX-License-Identifier: MIT
#include "common/image/pfm.hpp"

#include "common/image/file.hpp"

#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <locale>
#include <sstream>
#include <stdexcept>
#include <string>
#include <system_error>

namespace nephroid::examples {

static_assert(sizeof(float) == 4 && std::numeric_limits<float>::is_iec559, "PFM samples are IEEE 754 single precision");

namespace {

/// Bytes by shifting: the same file from a machine of either byte order.
void append_little_endian(std::string& bytes, float sample) {
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(sample);
    for (unsigned shift = 0; shift < 32; shift += 8)
        bytes.push_back(static_cast<char>(static_cast<unsigned char>(bits >> shift & 0xff)));
}

float sample_at(const std::string& bytes, std::size_t offset, bool little_endian) {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const auto byte = static_cast<unsigned char>(bytes[offset + (little_endian ? 3 - i : i)]);
        bits = bits << 8 | byte; // most significant first
    }
    return std::bit_cast<float>(bits);
}

[[noreturn]] void fail_to_read(const std::filesystem::path& path, const std::string& reason) {
    throw std::runtime_error("cannot read '" + path.string() + "': " + reason);
}

std::string read_bytes(const std::filesystem::path& path) {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (error)
        fail_to_read(path, error.message());
    std::ifstream stream(path, std::ios::binary);
    std::string bytes(static_cast<std::size_t>(size), '\0');
    if (!stream.read(bytes.data(), static_cast<std::streamsize>(size)))
        fail_to_read(path, "it cannot be opened, or not be read to its end");
    return bytes;
}

} // namespace

void write_pfm(const std::filesystem::path& path, const Samples& image) {
    require_writable_samples("write_pfm", image);
    std::string bytes = image.channels == 1 ? "Pf\n" : "PF\n";
    bytes += std::to_string(image.width) + " " + std::to_string(image.height) + "\n-1.0\n"; // negative: little endian
    bytes.reserve(bytes.size() + 4 * image.samples.size());
    for (const float sample : image.samples)
        append_little_endian(bytes, sample);
    write_file(path, bytes);
}

Samples read_pfm(const std::filesystem::path& path) {
    const std::string bytes = read_bytes(path);
    std::istringstream header(bytes.substr(0, 256)); // far longer than any header
    header.imbue(std::locale::classic());
    std::string magic;
    std::size_t width = 0, height = 0;
    double scale = 0;
    if (!(header >> magic) || (magic != "Pf" && magic != "PF"))
        fail_to_read(path, "it does not start with Pf or PF, so it is no PFM image");
    // A size above 2^24 a side is a damaged header; below it, no product of sizes overflows.
    constexpr std::size_t largest = std::size_t{1} << 24;
    if (!(header >> width >> height) || width == 0 || height == 0 || width > largest || height > largest)
        fail_to_read(path, "its header holds no valid width and height");
    if (!(header >> scale) || scale == 0 || !std::isfinite(scale) || !std::isspace(header.peek()))
        fail_to_read(path, "its header holds no valid scale");
    header.get(); // one white space, then samples

    const std::size_t channels = magic == "Pf" ? 1 : 3;
    const std::size_t count = width * height * channels, start = static_cast<std::size_t>(header.tellg());
    if (bytes.size() - start != 4 * count)
        fail_to_read(path, "it holds " + std::to_string(bytes.size() - start) +
                               " bytes of samples, its header promises " + std::to_string(4 * count));

    Samples image(width, height, channels, std::vector<float>(count));
    const auto magnitude = static_cast<float>(std::abs(scale));
    for (std::size_t i = 0; i < count; ++i)
        image.samples[i] = magnitude * sample_at(bytes, start + 4 * i, scale < 0);
    return image;
}

} // namespace nephroid::examples
