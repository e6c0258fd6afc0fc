// SPDX-License-Identifier: MIT
/// @file  Colours of spectral bands, and bands of colours.
#pragma once

#include "nephroid/emission/spectrum/bands.hpp"
#include "nephroid/emission/spectrum/equal_bands.hpp"

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace nephroid::examples {

/// The colour matching functions of the CIE 1931 standard observer, as a fit.
/// Source: Wyman, Sloan and Shirley 2013, "Simple analytic approximations to the CIE XYZ color matching functions".
///
/// @param wavelength  nanometres
[[nodiscard]] inline glm::dvec3 cie_1931(double wavelength) {
    const auto lobe = [wavelength](double height, double peak, double below, double above) {
        const double t = (wavelength - peak) / (wavelength < peak ? below : above);
        return height * std::exp(-0.5 * t * t);
    };
    return {lobe(1.056, 599.8, 37.9, 31.0) + lobe(0.362, 442.0, 16.0, 26.7) + lobe(-0.065, 501.1, 20.4, 26.2),
            lobe(0.821, 568.8, 46.9, 40.5) + lobe(0.286, 530.9, 16.3, 31.1),
            lobe(1.217, 437.0, 11.8, 36.0) + lobe(0.681, 459.0, 26.0, 13.8)};
}

/// Linear sRGB of CIE XYZ.
[[nodiscard]] inline glm::dvec3 srgb_of(const glm::dvec3& xyz) {
    return {3.2406 * xyz.x - 1.5372 * xyz.y - 0.4986 * xyz.z, -0.9689 * xyz.x + 1.8758 * xyz.y + 0.0415 * xyz.z,
            0.0557 * xyz.x - 0.2040 * xyz.y + 1.0570 * xyz.z};
}

/// Converts between bands and linear sRGB. Equal bands are white, and white is equal bands.
template <std::size_t B>
class SpectralColor {
public:
    using Flux = Bands<float, B>;

    explicit SpectralColor(const EqualBands<B>& spectrum) {
        constexpr int samples = 16;
        glm::dvec3 sum(0);
        for (std::size_t b = 0; b < B; ++b) {
            for (int i = 0; i < samples; ++i)
                color_[b] += srgb_of(cie_1931(spectrum.wavelength(double(b) + (i + 0.5) / samples)));
            sum += color_[b];
        }
        for (glm::dvec3& color : color_)
            color /= sum;
        // Red, green and blue as the shares of the bands that lie in three parts of the spectrum.
        glm::dmat3 primaries(0);
        for (std::size_t b = 0; b < B; ++b) {
            const auto below = [&](double end) { return (std::clamp)(spectrum.coordinate(end) - double(b), 0.0, 1.0); };
            primary_[b] = {1 - below(580), below(580) - below(490), below(490)};
            for (int c = 0; c < 3; ++c)
                primaries[c] += primary_[b][c] * color_[b];
        }
        shares_of_ = glm::inverse(primaries);
    }

    /// May be negative where light is more saturated than sRGB.
    [[nodiscard]] glm::vec3 color_of(const Flux& bands) const {
        glm::dvec3 color(0);
        for (std::size_t b = 0; b < B; ++b)
            color += double(bands[b]) * color_[b];
        return glm::vec3(color);
    }

    /// Bands of this colour, none of them negative: of very saturated ones the nearest there is.
    [[nodiscard]] Flux bands_of(const glm::vec3& color) const {
        const glm::dvec3 shares = shares_of_ * glm::dvec3(color);
        Flux bands;
        for (std::size_t b = 0; b < B; ++b)
            bands[b] = float((std::max)(glm::dot(shares, primary_[b]), 0.0));
        return bands;
    }

private:
    std::array<glm::dvec3, B> color_{}, primary_{};
    glm::dmat3 shares_of_{};
};

/// The colour of the same luminance that has no negative component: mixed with grey.
[[nodiscard]] inline glm::vec3 within_srgb(const glm::vec3& color) {
    const float least = (std::min)({color.x, color.y, color.z});
    const float luminance = (std::max)(0.2126f * color.x + 0.7152f * color.y + 0.0722f * color.z, 0.f);
    if (!(least < 0))
        return color;
    return glm::max(luminance + (color - luminance) * (luminance / (luminance - least)), glm::vec3(0));
}

} // namespace nephroid::examples
