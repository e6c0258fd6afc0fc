// SPDX-License-Identifier: MIT
/// @file  The image type of the examples, and the flat array of samples that image files hold.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace nephroid::examples {

/// Linear red, green and blue.
using Rgb = std::array<float, 3>;

/// Pixels in rows. Row 0 is the *bottom* row: the smallest y of a floor, the lowest row of a camera's film.
/// Every writer and reader turns this into the order that its file format wants.
template <class Pixel>
struct Image {
    std::size_t width = 0, height = 0;
    std::vector<Pixel> pixels; ///< width * height of them; pixel (x, y) is at y * width + x

    Image() = default;
    Image(std::size_t width_, std::size_t height_, Pixel fill = Pixel{})
        : width(width_), height(height_), pixels(width_ * height_, fill) {}

    /// Column x from the left, row y from the bottom; neither is checked.
    [[nodiscard]] Pixel& operator()(std::size_t x, std::size_t y) { return pixels[y * width + x]; }
    [[nodiscard]] const Pixel& operator()(std::size_t x, std::size_t y) const { return pixels[y * width + x]; }
};

/// A pixel of one channel.
template <class P>
concept GreyPixel = std::floating_point<P>;

/// A pixel of three channels, by index: Rgb, `std::array<double, 3>`, `glm::vec3`.
template <class P>
concept ColourPixel = !GreyPixel<P> && requires(const P pixel) {
    { pixel[0] } -> std::convertible_to<double>;
    requires sizeof(pixel) >= 3 * sizeof(pixel[0]);
};

/// An image as a file holds it: 32-bit samples, grey or red, green, blue. Converts from any `Image`.
struct Samples {
    std::size_t width = 0, height = 0;
    std::size_t channels = 1;   ///< 1 or 3
    std::vector<float> samples; ///< pixel by pixel, row 0 at the bottom: (y * width + x) * channels + channel

    Samples() = default;
    Samples(std::size_t width_, std::size_t height_, std::size_t channels_, std::vector<float> samples_)
        : width(width_), height(height_), channels(channels_), samples(std::move(samples_)) {}

    template <GreyPixel P>
    Samples(const Image<P>& image) : width(image.width), height(image.height) {
        samples.reserve(image.pixels.size());
        for (const P pixel : image.pixels)
            samples.push_back(static_cast<float>(pixel));
    }

    template <ColourPixel P>
    Samples(const Image<P>& image) : width(image.width), height(image.height), channels(3) {
        samples.reserve(3 * image.pixels.size());
        for (const P& pixel : image.pixels)
            for (const float sample :
                 {static_cast<float>(pixel[0]), static_cast<float>(pixel[1]), static_cast<float>(pixel[2])})
                samples.push_back(sample);
    }
};

/// Refuses images without pixels, with a wrong number of them, or with samples that are infinite or NaN (a double
/// beyond the range of float counts as infinite). Throws std::invalid_argument that names the pixel.
///
/// @param function  whose argument it is, for the message: "write_pfm"
void require_writable_samples(const std::string& function, const Samples& image);

} // namespace nephroid::examples
