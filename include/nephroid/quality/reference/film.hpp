// SPDX-License-Identifier: MIT
/// @file  The rectangle of the floor z = 0 that an exact image of a caustic shows, and the image.
#pragma once

#include "nephroid/vector/error.hpp"
#include "nephroid/vector/text.hpp"

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace nephroid::reference {

/// A rectangle of the plane z = 0, seen from above without perspective and divided into width × height equal pixels. A
/// pixel shows the irradiance averaged over its rectangle.
struct Film {
    double x_min = 0, x_max = 1;   ///< world units, x_min < x_max
    double y_min = 0, y_max = 1;   ///< world units, y_min < y_max
    int width = 512, height = 512; ///< pixels along x and along y, 1 to 65536

    [[nodiscard]] double pixel_width() const { return (x_max - x_min) / width; }
    [[nodiscard]] double pixel_height() const { return (y_max - y_min) / height; }
    /// The left side of pixel column `i`, and for i = width the right side of the film: neighbours share it exactly.
    [[nodiscard]] double x(int i) const { return x_min + (x_max - x_min) * i / width; }
    /// The lower side of pixel row `j`.
    [[nodiscard]] double y(int j) const { return y_min + (y_max - y_min) * j / height; }
};

/// Irradiances, row after row: pixel (i, j) is at [j * width + i], and row 0 has the *smallest* y.
using Image = std::vector<double>;

/// @return  the mean of the pixels: the flux on the film over its area. 0 for no pixels.
[[nodiscard]] inline double mean(const Image& image) {
    double sum = 0;
    for (const double pixel : image)
        sum += pixel;
    return image.empty() ? 0 : sum / static_cast<double>(image.size());
}

namespace detail {

/// Throws `std::invalid_argument` "nephroid::reference::<function>: <name> is <value>, but must <rule>" unless `valid`.
inline void require(bool valid, const char* function, const char* name, double value, const char* rule) {
    if (!valid)
        invalid_argument(std::string("nephroid::reference::") + function + ": " + name + " is " +
                         nephroid::detail::text_of(value) + ", but must " + rule);
}

/// Makes an image with a zero for each pixel of the film.
///
/// @param function  the caller's name for the message, e.g. "wave"
/// Throws `std::invalid_argument` if the film is not as its members' comments say.
inline Image blank(const Film& film, const char* function) {
    require(std::isfinite(film.x_min), function, "film.x_min", film.x_min, "be finite");
    require(std::isfinite(film.y_min), function, "film.y_min", film.y_min, "be finite");
    require(std::isfinite(film.x_max) && film.x_max > film.x_min, function, "film.x_max", film.x_max,
            "be finite and above film.x_min");
    require(std::isfinite(film.y_max) && film.y_max > film.y_min, function, "film.y_max", film.y_max,
            "be finite and above film.y_min");
    require(film.width >= 1 && film.width <= 65536, function, "film.width", film.width, "lie in 1 to 65536");
    require(film.height >= 1 && film.height <= 65536, function, "film.height", film.height, "lie in 1 to 65536");
    return Image(static_cast<std::size_t>(film.width) * static_cast<std::size_t>(film.height));
}

} // namespace detail
} // namespace nephroid::reference
