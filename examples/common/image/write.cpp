// SPDX-License-Identifier: MIT
#include "common/image/write.hpp"

#include "common/image/exr.hpp"
#include "common/image/file.hpp"
#include "common/image/pfm.hpp"
#include "common/image/png.hpp"

#include <stdexcept>
#include <string>

namespace nephroid::examples {

namespace {

enum class Format { exr, pfm, png };

Format format_of(const std::filesystem::path& path) {
    const std::string extension = path.extension().string();
    std::string lower = extension;
    for (char& letter : lower)
        if (letter >= 'A' && letter <= 'Z')
            letter = static_cast<char>(letter - 'A' + 'a');

    if (lower == ".exr")
        return Format::exr;
    if (lower == ".pfm")
        return Format::pfm;
    if (lower == ".png")
        return Format::png;
    throw std::invalid_argument("cannot write '" + path.string() + "': " +
                                (extension.empty() ? "it has no extension" : "unknown extension '" + extension + "'") +
                                ", choose .exr, .pfm or .png");
}

} // namespace

void write_image(const std::filesystem::path& path, const Samples& image, double exposure) {
    switch (format_of(path)) {
    case Format::exr:
        return write_exr(path, image);
    case Format::pfm:
        return write_pfm(path, image);
    case Format::png:
        return write_png(path, image, exposure);
    }
}

void require_writable_image(const std::filesystem::path& path) {
    if (format_of(path) == Format::exr)
        require_openexr(path);
    require_writable(path);
}

} // namespace nephroid::examples
