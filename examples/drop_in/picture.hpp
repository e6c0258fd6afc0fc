// SPDX-License-Identifier: MIT
/// @file  What the renderers of this folder share: nothing but a way to write their pictures.
#pragma once

#include <bit>
#include <cstddef>
#include <fstream>
#include <span>
#include <string>

/// Writes irradiances as a .pfm, row 0 at the bottom.
///
/// @param channels  of each pixel: 1 for grey, 3 for colours
/// @return  whether all went into the file
[[nodiscard]] inline bool write_pfm(const std::string& path, std::size_t width, std::size_t channels,
                                    std::span<const float> samples) {
    const std::size_t height = samples.size() / (width * channels);
    std::ofstream file(path, std::ios::binary);
    file << (channels == 1 ? "Pf\n" : "PF\n") << width << ' ' << height << '\n'
         << (std::endian::native == std::endian::little ? "-1.0\n" : "1.0\n");
    file.write(reinterpret_cast<const char*>(samples.data()), static_cast<std::streamsize>(samples.size_bytes()));
    return bool(file.flush());
}
