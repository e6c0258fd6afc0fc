// SPDX-License-Identifier: MIT
/// @file  How far an image is from its reference, pixel by pixel: RMSE, relative error, energy error.
#pragma once

#include "nephroid/quality/pixels.hpp"

#include <cmath>
#include <cstddef>
#include <ranges>
#include <string>

namespace nephroid {

namespace detail {

/// The sum in double precision; n pixels cost a relative error of at most n epsilon when none is negative.
template <Pixels Image>
[[nodiscard]] double sum_of(const Image& image) {
    double sum = 0;
    for (const auto pixel : image)
        sum += static_cast<double>(pixel);
    return sum;
}

/// `rmse` without its checks.
template <Pixels Image, Pixels Reference>
[[nodiscard]] double rms_difference(const Image& image, const Reference& reference) {
    const auto* const image_pixels = std::ranges::data(image);
    const auto* const reference_pixels = std::ranges::data(reference);
    const std::size_t size = std::ranges::size(image);
    double sum = 0;
    for (std::size_t i = 0; i < size; ++i) {
        const double difference = static_cast<double>(image_pixels[i]) - static_cast<double>(reference_pixels[i]);
        sum += difference * difference;
    }
    return std::sqrt(sum / static_cast<double>(size));
}

/// The sum of a reference, which an error is divided by: refused unless positive.
template <Pixels Reference>
[[nodiscard]] double positive_sum(const char* function, const Reference& reference) {
    const double sum = sum_of(reference);
    if (!(sum > 0)) {
        const double mean = sum / static_cast<double>(std::ranges::size(reference));
        invalid_argument(std::string(function) + ": the reference's mean is " + std::to_string(mean) +
                         ", it must be positive");
    }
    return sum;
}

} // namespace detail

/// Root of the mean squared difference, in the unit of the pixels: rms(E - E_ref).
///
/// @param image      the pixels to judge, any unit
/// @param reference  as many pixels, same order and unit; `float` and `double` may be mixed
/// @return  >= 0, in double precision. Not checked: squares overflow for pixels beyond 1e150.
template <Pixels Image, Pixels Reference>
[[nodiscard]] double rmse(const Image& image, const Reference& reference) {
    detail::require_comparable("nephroid::rmse", image, reference);
    return detail::rms_difference(image, reference);
}

/// The RMSE as a fraction of the reference's mean: rms(E - E_ref) / mean(E_ref), the `rel` of nephroid's tables.
///
/// @param image      irradiance or radiance, linear and not clipped
/// @param reference  as many pixels, with a positive mean
/// @return  >= 0; the same for any unit, so images of different exposure can be compared
template <Pixels Image, Pixels Reference>
[[nodiscard]] double relative_error(const Image& image, const Reference& reference) {
    detail::require_comparable("nephroid::relative_error", image, reference);
    const double sum = detail::positive_sum("nephroid::relative_error", reference);
    return detail::rms_difference(image, reference) / (sum / static_cast<double>(std::ranges::size(reference)));
}

/// How much of the reference's energy is lost (negative) or gained (positive): sum(E) / sum(E_ref) - 1.
///
/// @param image      irradiance, linear and not clipped, pixels of equal area
/// @param reference  as many pixels, with a positive mean
/// @return  -0.01 where one per cent is lost; 0 for blur, which moves energy and loses none
template <Pixels Image, Pixels Reference>
[[nodiscard]] double energy_error(const Image& image, const Reference& reference) {
    detail::require_comparable("nephroid::energy_error", image, reference);
    const double sum = detail::positive_sum("nephroid::energy_error", reference);
    return detail::sum_of(image) / sum - 1;
}

} // namespace nephroid
