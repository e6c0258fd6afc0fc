// SPDX-License-Identifier: MIT
#include "common/image/image.hpp"

#include <cmath>
#include <stdexcept>

namespace nephroid::examples {

void require_writable_samples(const std::string& function, const Samples& image) {
    const std::string size = std::to_string(image.width) + " x " + std::to_string(image.height);
    if (image.width == 0 || image.height == 0)
        throw std::invalid_argument(function + ": the image is empty, " + size + " pixels");
    if (image.channels != 1 && image.channels != 3)
        throw std::invalid_argument(function + ": the image has " + std::to_string(image.channels) +
                                    " channels, files hold 1 or 3");
    if (image.samples.size() != image.width * image.height * image.channels)
        throw std::invalid_argument(function + ": the image has " + std::to_string(image.samples.size()) +
                                    " samples, which is not " + size + " x " + std::to_string(image.channels));

    for (std::size_t i = 0; i < image.samples.size(); ++i)
        if (!std::isfinite(image.samples[i])) {
            const std::size_t pixel = i / image.channels;
            throw std::invalid_argument(function + ": pixel (" + std::to_string(pixel % image.width) + ", " +
                                        std::to_string(pixel / image.width) + "), counted from the bottom left, is " +
                                        std::to_string(image.samples[i]) + ", every pixel must be finite");
        }
}

} // namespace nephroid::examples
