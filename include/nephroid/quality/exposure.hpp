// SPDX-License-Identifier: MIT
/// @file  Errors of pictures as a viewer sees them: both images exposed by the reference's median and clipped.
#pragma once

#include "nephroid/quality/error.hpp"
#include "nephroid/quality/ssim.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <ranges>
#include <string>
#include <vector>

namespace nephroid {

/// The factor that shows the median of the lit pixels as middle grey: 0.5 / median(E_ref > 0).
///
/// A caustic's peaks are unbounded and its shadows black, so neither the maximum nor the mean gives a steady exposure.
/// @param reference  irradiance or radiance, linear; lit pixels are those above 0, and there must be one.
///                   The median of an even number of pixels is the mean of the middle two
/// @return  > 0, per unit of the pixels
template <Pixels Reference>
[[nodiscard]] double picture_exposure(const Reference& reference) {
    detail::require_finite_pixels("nephroid::picture_exposure", "reference", reference);
    std::vector<double> lit;
    for (const auto pixel : reference)
        if (pixel > 0)
            lit.push_back(static_cast<double>(pixel));
    if (lit.empty())
        invalid_argument(
            "nephroid::picture_exposure: no reference pixel is above 0, so there is nothing to expose for");

    const auto upper = lit.begin() + static_cast<std::ptrdiff_t>(lit.size() / 2);
    std::nth_element(lit.begin(), upper, lit.end());
    const double lower = lit.size() % 2 == 1 ? *upper : *std::max_element(lit.begin(), upper);
    const double exposure = 0.5 / (0.5 * lower + 0.5 * *upper);
    if (!std::isfinite(exposure) || exposure == 0)
        invalid_argument("nephroid::picture_exposure: the median of the lit reference pixels is out of range, " +
                         std::to_string(*upper));
    return exposure;
}

/// The picture that a viewer sees of an image: clip(E * exposure, 0, 1).
///
/// @param image     linear, finite (not checked)
/// @param exposure  > 0, from `picture_exposure` of the reference for both images of a comparison
/// @return  as many pixels, each in [0, 1], still linear
template <Pixels Image>
[[nodiscard]] std::vector<double> exposed(const Image& image, double exposure) {
    std::vector<double> picture;
    picture.reserve(std::ranges::size(image));
    for (const auto pixel : image)
        picture.push_back(std::clamp(static_cast<double>(pixel) * exposure, 0.0, 1.0));
    return picture;
}

/// How an image differs from its reference as a picture.
struct PictureError {
    double rmse = 0; ///< of the exposed and clipped pixels, in [0, 1]
    double ssim = 1; ///< of the same, in [-1, 1]; 1 where they are equal
};

/// Clipped RMSE and SSIM: both images exposed by the *reference's* median, clipped to [0, 1], then compared.
///
/// @param image      width * height pixels, row-major, linear
/// @param reference  as many, same unit, with at least one pixel above 0
/// @param width, height  in pixels, each at least options.window
/// @param options    of the SSIM; a dynamic range of 1, the default, is the right one here
template <Pixels Image, Pixels Reference>
[[nodiscard]] PictureError picture_error(const Image& image, const Reference& reference, std::size_t width,
                                         std::size_t height, const SsimOptions& options = {}) {
    detail::require_comparable("nephroid::picture_error", image, reference);
    detail::require_resolution("nephroid::picture_error", image, width, height);
    const double exposure = picture_exposure(reference);
    const std::vector<double> seen = exposed(image, exposure), expected = exposed(reference, exposure);
    return {rmse(seen, expected), ssim(seen, expected, width, height, options)};
}

} // namespace nephroid
