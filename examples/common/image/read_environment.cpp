// SPDX-License-Identifier: MIT
#include "common/image/read_environment.hpp"

#include "common/image/decode.hpp"
#include "common/image/exr.hpp"
#include "common/image/pfm.hpp"
#include "common/image/read_png.hpp"

#include <stdexcept>
#include <string>

namespace nephroid::examples {

Samples read_environment(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    for (char& letter : extension)
        if (letter >= 'A' && letter <= 'Z')
            letter = static_cast<char>(letter - 'A' + 'a');
    if (extension == ".pfm")
        return read_pfm(path);
    if (extension == ".png")
        return Samples(read_png(path));
    if (extension == ".hdr")
        return read_hdr(path);
    if (extension == ".exr")
        return read_exr(path);
    throw std::runtime_error("cannot read '" + path.string() + "' as light from all around: choose .hdr, .exr, .pfm, " +
                             ".png, or the word constant");
}

} // namespace nephroid::examples
