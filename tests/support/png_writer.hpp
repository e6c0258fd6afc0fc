// SPDX-License-Identifier: MIT
/// @file  Writes small PNG files for tests, byte by byte as given.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace nephroid::tests {

/// A PNG of 8 bits for red, green, blue and opacity, not compressed.
///
/// @param rgba  width * height of them, the top row first
[[nodiscard]] inline std::string png_bytes(std::uint32_t width, std::uint32_t height,
                                           const std::vector<std::array<std::uint8_t, 4>>& rgba) {
    const auto big_endian = [](std::uint32_t value) {
        std::string bytes;
        for (int shift = 24; shift >= 0; shift -= 8)
            bytes += static_cast<char>(static_cast<unsigned char>(value >> shift));
        return bytes;
    };
    const auto chunk = [&](const std::string& type, const std::string& content) {
        std::uint32_t crc = 0xFFFFFFFFu;
        for (const char c : type + content) {
            crc ^= static_cast<unsigned char>(c);
            for (int bit = 0; bit < 8; ++bit)
                crc = (crc & 1u) != 0 ? crc >> 1 ^ 0xEDB88320u : crc >> 1;
        }
        return big_endian(static_cast<std::uint32_t>(content.size())) + type + content + big_endian(~crc);
    };

    std::string rows;
    for (std::uint32_t y = 0; y < height; ++y) {
        rows += '\0'; // no filter
        for (std::uint32_t x = 0; x < width; ++x)
            for (const std::uint8_t sample : rgba[std::size_t{y} * width + x])
                rows += static_cast<char>(sample);
    }
    std::string packed = "\x78\x01"; // zlib, of blocks that are stored
    std::uint32_t a = 1, b = 0;
    for (const char c : rows) {
        a = (a + static_cast<unsigned char>(c)) % 65521;
        b = (b + a) % 65521;
    }
    for (std::size_t at = 0; at < rows.size(); at += 65535) {
        const std::string block = rows.substr(at, 65535);
        const auto size = static_cast<unsigned>(block.size());
        packed += at + 65535 >= rows.size() ? '\x01' : '\0';
        for (const unsigned number : {size, ~size})
            for (const unsigned shift : {0u, 8u})
                packed += static_cast<char>(static_cast<unsigned char>(number >> shift));
        packed += block;
    }
    packed += big_endian(b << 16 | a);
    return "\x89PNG\r\n\x1a\n" +
           chunk("IHDR", big_endian(width) + big_endian(height) + std::string("\x08\x06\0\0\0", 5)) +
           chunk("IDAT", packed) + chunk("IEND", "");
}

} // namespace nephroid::tests
