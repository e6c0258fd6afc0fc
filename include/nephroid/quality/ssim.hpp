// SPDX-License-Identifier: MIT
/// @file  Structural similarity (SSIM): how alike two images look, by local means, contrasts and correlation.
#pragma once

#include "nephroid/quality/error.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <ranges>
#include <string>
#include <vector>

namespace nephroid {

/// The parameters of `ssim`; the defaults are those of Wang et al. 2004, for pixels in [0, 1].
struct SsimOptions {
    std::size_t window = 11;  ///< side of the square Gaussian window, pixels, >= 1
    double sigma = 1.5;       ///< standard deviation of the Gaussian before it is cut off and normalised, pixels, > 0
    double k1 = 0.01;         ///< stabilises the comparison of dark means, > 0: C1 = (k1 dynamic_range)^2
    double k2 = 0.03;         ///< stabilises the comparison of low contrasts, > 0: C2 = (k2 dynamic_range)^2
    double dynamic_range = 1; ///< largest minus smallest value that a pixel can have, > 0: 1 for [0, 1], 255 for bytes
};

namespace detail {

/// Weighted means under a window: image, reference, their squares, their product.
struct SsimMoments {
    double a = 0, b = 0, aa = 0, bb = 0, ab = 0;

    void add(double weight, const SsimMoments& m) {
        a += weight * m.a, b += weight * m.b;
        aa += weight * m.aa, bb += weight * m.bb, ab += weight * m.ab;
    }
};

/// Refuses parameters that make no window, or a division by zero.
inline void require_ssim_options(const SsimOptions& options, std::size_t width, std::size_t height) {
    const auto require_positive = [](const char* name, double value) {
        if (!(value > 0) || !std::isfinite(value))
            invalid_argument(std::string("nephroid::ssim: ") + name + " is " + std::to_string(value) +
                             ", it must be positive and finite");
    };
    require_positive("sigma", options.sigma);
    require_positive("k1", options.k1);
    require_positive("k2", options.k2);
    require_positive("dynamic_range", options.dynamic_range);
    if (options.window == 0 || options.window > width || options.window > height)
        invalid_argument("nephroid::ssim: no window of " + std::to_string(options.window) +
                         " pixels a side lies inside an image of " + std::to_string(width) + " x " +
                         std::to_string(height));
}

/// One axis of the separable window: a Gaussian about its middle, with sum 1.
[[nodiscard]] inline std::vector<double> ssim_weights(const SsimOptions& options) {
    std::vector<double> weights(options.window);
    double sum = 0;
    for (std::size_t i = 0; i < options.window; ++i) {
        const double offset = static_cast<double>(i) - 0.5 * static_cast<double>(options.window - 1);
        weights[i] = std::exp(-0.5 * offset * offset / (options.sigma * options.sigma));
        sum += weights[i];
    }
    for (double& weight : weights)
        weight /= sum;
    return weights;
}

} // namespace detail

/// Mean structural similarity of two images of one channel.
///
/// The mean, over all windows that lie wholly inside the image, of
/// (2 mu_a mu_b + C1)(2 cov_ab + C2) / ((mu_a^2 + mu_b^2 + C1)(var_a + var_b + C2)), moments under the Gaussian window.
///
/// @param image      width * height pixels, row-major, meant to span [0, options.dynamic_range]; not clipped here
/// @param reference  as many pixels; `float` and `double` may be mixed. Symmetric in the two
/// @param width, height  in pixels, each at least options.window
/// @return  in [-1, 1] for pixels that are not negative; 1 only for equal images
/// Time O(pixels * window), memory O(width * window), double precision throughout.
/// Source: Wang, Bovik, Sheikh, Simoncelli 2004, "Image Quality Assessment: From Error Visibility to
/// Structural Similarity".
template <Pixels Image, Pixels Reference>
[[nodiscard]] double ssim(const Image& image, const Reference& reference, std::size_t width, std::size_t height,
                          const SsimOptions& options = {}) {
    detail::require_comparable("nephroid::ssim", image, reference);
    detail::require_resolution("nephroid::ssim", image, width, height);
    detail::require_ssim_options(options, width, height);

    const auto* const a = std::ranges::data(image);
    const auto* const b = std::ranges::data(reference);
    // About each image's mean: an offset does not change a variance, but its rounding would.
    const double mean_a = detail::sum_of(image) / static_cast<double>(width * height);
    const double mean_b = detail::sum_of(reference) / static_cast<double>(width * height);
    const double c1 = options.k1 * options.dynamic_range * options.k1 * options.dynamic_range;
    const double c2 = options.k2 * options.dynamic_range * options.k2 * options.dynamic_range;

    const std::size_t window = options.window, columns = width - window + 1, rows = height - window + 1;
    const std::vector<double> weights = detail::ssim_weights(options);
    std::vector<detail::SsimMoments> pixels(width); // of the current row
    // The last `window` rows, filtered along x: row y is at y % window.
    std::vector<detail::SsimMoments> filtered(window * columns);

    double sum = 0;
    for (std::size_t y = 0; y < height; ++y) {
        for (std::size_t x = 0; x < width; ++x) {
            const double pa = static_cast<double>(a[y * width + x]) - mean_a;
            const double pb = static_cast<double>(b[y * width + x]) - mean_b;
            pixels[x] = {pa, pb, pa * pa, pb * pb, pa * pb};
        }
        for (std::size_t x = 0; x < columns; ++x) {
            detail::SsimMoments along_x;
            for (std::size_t i = 0; i < window; ++i)
                along_x.add(weights[i], pixels[x + i]);
            filtered[(y % window) * columns + x] = along_x;
        }
        if (y + 1 < window)
            continue;

        for (std::size_t x = 0; x < columns; ++x) {
            detail::SsimMoments m;
            for (std::size_t i = 0; i < window; ++i)
                m.add(weights[i], filtered[((y + 1 + i) % window) * columns + x]); // oldest row first
            const double mu_a = mean_a + m.a, mu_b = mean_b + m.b;
            const double variances = (m.aa - m.a * m.a) + (m.bb - m.b * m.b), covariance = m.ab - m.a * m.b;
            sum +=
                (2 * mu_a * mu_b + c1) * (2 * covariance + c2) / ((mu_a * mu_a + mu_b * mu_b + c1) * (variances + c2));
        }
    }
    return sum / static_cast<double>(columns * rows);
}

} // namespace nephroid
