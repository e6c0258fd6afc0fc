// SPDX-License-Identifier: MIT
#include "quality/pictures.hpp"

#include "nephroid/quality/exposure.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace nephroid::tests::exposure_test {

TEST_CASE("picture_exposure: shows the median of the lit pixels at one half") {
    CHECK(picture_exposure(std::array<float, 5>{0, 8, 2, 0, 1000}) == 0.5 / 8);  // lit: 2, 8, 1000
    CHECK(picture_exposure(std::array<double, 4>{1, 1000, 3, 2}) == 0.5 / 2.5);  // even: between 2 and 3
    CHECK(picture_exposure(std::array<double, 4>{-5, -1e-9, 0, 4}) == 0.5 / 4);  // neither 0 nor below is lit
    CHECK(picture_exposure(std::array<double, 2>{1e308, 1e308}) == 0.5 / 1e308); // the middle two do not overflow
}

TEST_CASE("exposed: scales, then clips below at 0 and above at 1") {
    const std::vector<double> picture = exposed(std::array<float, 5>{-1, 0, 1, 2, 3}, 0.5);
    CHECK(picture == std::vector<double>{0, 0, 0.5, 1, 1});
}

// Exposure is 0.5 / 2; the two peaks, 40 and 4000, are both white.
TEST_CASE("picture_error: what is white in both pictures is no error") {
    std::vector<float> reference(11 * 11, 2.0f), image = reference;
    reference[60] = 40, image[60] = 4000;
    const PictureError error = picture_error(image, reference, 11, 11);
    CHECK(error.rmse == 0);
    CHECK(std::abs(error.ssim - 1) <= 1e-12);
}

// Both are flat: 2 shows as 0.5, 3 as 0.75 by the reference's exposure (0.5 by its own, which would hide the error).
TEST_CASE("picture_error: the image is exposed by the reference's median, not by its own") {
    const std::vector<double> reference(12 * 11, 2.0), image(12 * 11, 3.0);
    const PictureError error = picture_error(image, reference, 12, 11);
    CHECK(error.rmse == 0.25);
    const double expected = (2 * 0.5 * 0.75 + 1e-4) / (0.25 + 0.5625 + 1e-4);
    CHECK(std::abs(error.ssim - expected) <= 1e-10); // rounding over C1, as in ssim_test.cpp
}

TEST_CASE("picture_error: does not depend on the unit of the pixels") {
    const std::vector<float> reference = tests::noise_picture(16, 14, 11), image = tests::noise_picture(16, 14, 12);
    std::vector<float> scaled_reference, scaled_image;
    for (std::size_t i = 0; i < image.size(); ++i) {
        scaled_reference.push_back(1024 * reference[i]); // a power of two: no rounding
        scaled_image.push_back(1024 * image[i]);
    }
    const PictureError error = picture_error(image, reference, 16, 14);
    const PictureError scaled = picture_error(scaled_image, scaled_reference, 16, 14);
    CHECK(error.rmse > 0.1);
    CHECK(scaled.rmse == error.rmse);
    CHECK(scaled.ssim == error.ssim);
}

TEST_CASE("picture_error: a wrong call is refused with the value that is wrong") {
    const std::vector<double> dark(11 * 11, 0.0), lit(11 * 11, 1.0), small(10 * 10, 1.0);
    CHECK_THROWS_WITH_AS((void)picture_error(lit, dark, 11, 11),
                         "nephroid::picture_exposure: no reference pixel is above 0, so there is nothing to expose for",
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS((void)picture_error(lit, small, 11, 11),
                         "nephroid::picture_error: image has 121 pixels, reference has 100", std::invalid_argument);
    CHECK_THROWS_WITH_AS((void)picture_error(lit, lit, 11, 12),
                         "nephroid::picture_error: image has 121 pixels, which is not 11 x 12", std::invalid_argument);
    CHECK_THROWS_WITH_AS((void)picture_error(small, small, 10, 10),
                         "nephroid::ssim: no window of 11 pixels a side lies inside an image of 10 x 10",
                         std::invalid_argument);
    // 0.5 over the smallest double is infinite.
    CHECK_THROWS_AS((void)picture_exposure(std::array<double, 1>{std::numeric_limits<double>::denorm_min()}),
                    std::invalid_argument);
    CHECK_THROWS_WITH_AS((void)picture_exposure(std::vector<float>{}),
                         "nephroid::picture_exposure: reference has no pixels", std::invalid_argument);
}

} // namespace nephroid::tests::exposure_test
