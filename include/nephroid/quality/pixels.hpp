// SPDX-License-Identifier: MIT
/// @file  The concept of an image's pixels, and checks of the images that are compared.
#pragma once

#include "nephroid/vector/error.hpp"

#include <cmath>
#include <concepts>
#include <cstddef>
#include <ranges>
#include <string>

namespace nephroid {

/// The pixels of one channel, contiguous: `std::vector<float>`, `std::span<const double>`, ...
/// Row-major where a measure also takes width and height; either end may be up. Measure a colour image channel by
/// channel, or its luminance.
template <class P>
concept Pixels = std::ranges::contiguous_range<const P> && std::ranges::sized_range<const P> &&
    std::floating_point<std::ranges::range_value_t<const P>>;

namespace detail {

/// Refuses an empty image and one with an infinite or undefined pixel.
///
/// @param function  whose argument it is, for the message: "nephroid::rmse"
/// @param name      of that argument, for the message: "reference"
template <Pixels Image>
void require_finite_pixels(const char* function, const char* name, const Image& image) {
    if (std::ranges::size(image) == 0)
        invalid_argument(std::string(function) + ": " + name + " has no pixels");

    std::size_t index = 0;
    for (const auto pixel : image) {
        if (!std::isfinite(pixel))
            invalid_argument(std::string(function) + ": " + name + " pixel " + std::to_string(index) + " is " +
                             std::to_string(pixel) + ", every pixel must be finite");
        ++index;
    }
}

/// Refuses two images that cannot be compared pixel by pixel: of different sizes, empty, or not finite.
template <Pixels Image, Pixels Reference>
void require_comparable(const char* function, const Image& image, const Reference& reference) {
    if (std::ranges::size(image) != std::ranges::size(reference))
        invalid_argument(std::string(function) + ": image has " + std::to_string(std::ranges::size(image)) +
                         " pixels, reference has " + std::to_string(std::ranges::size(reference)));
    require_finite_pixels(function, "image", image);
    require_finite_pixels(function, "reference", reference);
}

/// Refuses a width and height that do not multiply to the number of pixels.
template <Pixels Image>
void require_resolution(const char* function, const Image& image, std::size_t width, std::size_t height) {
    const std::size_t size = std::ranges::size(image);
    // By division: a product of absurd sizes could wrap around to the right number.
    const bool matches = width != 0 && height == size / width && size % width == 0;
    if (!matches)
        invalid_argument(std::string(function) + ": image has " + std::to_string(size) + " pixels, which is not " +
                         std::to_string(width) + " x " + std::to_string(height));
}

} // namespace detail
} // namespace nephroid
