// SPDX-License-Identifier: MIT
#include "quality/pictures.hpp"

#include "nephroid/quality/error.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <list>
#include <span>
#include <stdexcept>
#include <vector>

namespace nephroid::tests::error_test {

static_assert(Pixels<std::vector<float>> && Pixels<std::span<const double>> && Pixels<std::array<float, 4>>);
static_assert(!Pixels<std::vector<int>> && !Pixels<std::list<float>> && !Pixels<float>);

TEST_CASE("rmse: an image that is off by a constant is off by that constant") {
    const std::vector<float> reference = tests::noise_picture(13, 7, 1);
    std::vector<double> above, below;
    for (const float pixel : reference) {
        above.push_back(pixel + 0.25); // exact: multiples of 1/256 below 2
        below.push_back(pixel - 0.25);
    }
    CHECK(rmse(above, reference) == 0.25);
    CHECK(rmse(below, reference) == 0.25);
    CHECK(rmse(reference, above) == 0.25);
    CHECK(rmse(reference, reference) == 0);
}

TEST_CASE("rmse: one wrong pixel of n counts with its square over n") {
    const std::array<double, 4> reference{1, 2, 3, 4};
    const std::array<double, 4> image{1, 2, 9, 4};
    CHECK(rmse(image, reference) == 3); // sqrt(36 / 4)
}

TEST_CASE("rmse: float and double pixels, vectors and spans, compare in double precision") {
    const std::vector<float> image{1.0f};
    const double reference = 1 + 0x1p-40; // rounds to 1 as a float
    CHECK(rmse(image, std::span<const double>(&reference, 1)) == 0x1p-40);
}

// Scaling image and reference by g scales rms and mean alike.
TEST_CASE("relative_error: is the RMSE over the reference's mean and does not depend on the unit") {
    const std::array<double, 4> reference{1, 2, 3, 4}, image{1, 2, 9, 4};
    CHECK(relative_error(image, reference) == 3 / 2.5);

    std::array<double, 4> scaled_reference{}, scaled_image{};
    for (std::size_t i = 0; i < 4; ++i) {
        scaled_reference[i] = 1024 * reference[i]; // a power of two: no rounding
        scaled_image[i] = 1024 * image[i];
    }
    CHECK(relative_error(scaled_image, scaled_reference) == 3 / 2.5);
}

TEST_CASE("energy_error: a blur that keeps the sum has none, a lost quarter is minus a quarter") {
    const std::array<double, 4> reference{0, 8, 0, 0};
    CHECK(energy_error(std::array<double, 4>{2, 4, 2, 0}, reference) == 0);
    CHECK(energy_error(std::array<double, 4>{0, 6, 0, 0}, reference) == -0.25);
    CHECK(energy_error(std::array<double, 4>{0, 8, 8, 0}, reference) == 1);
}

// 2^24 + 1 is not a float: a float sum would lose every second pixel from there on.
TEST_CASE("energy_error: the sum of many float pixels is carried in double precision") {
    std::vector<float> reference(1000, 1.0f);
    reference[0] = 0x1p24f;
    std::vector<float> image = reference;
    image[999] = 2.0f;
    const double sum = 0x1p24 + 999;
    const double tolerance = 2 * std::numeric_limits<double>::epsilon(); // the quotient, near 1, is rounded twice
    CHECK(std::abs(energy_error(image, reference) - 1 / sum) <= tolerance);
}

TEST_CASE("error measures: a wrong call is refused with the value that is wrong") {
    const std::vector<double> two{1, 2}, three{1, 2, 3}, none, dark{0, 0}, negative{-1, -3};
    const std::vector<float> infinite{1, std::numeric_limits<float>::infinity()};
    const std::vector<float> undefined{std::numeric_limits<float>::quiet_NaN(), 1};

    CHECK_THROWS_WITH_AS((void)rmse(two, three), "nephroid::rmse: image has 2 pixels, reference has 3",
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS((void)rmse(none, none), "nephroid::rmse: image has no pixels", std::invalid_argument);
    CHECK_THROWS_WITH_AS((void)relative_error(infinite, two),
                         "nephroid::relative_error: image pixel 1 is inf, every pixel must be finite",
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS((void)energy_error(two, undefined),
                         "nephroid::energy_error: reference pixel 0 is nan, every pixel must be finite",
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS((void)relative_error(two, dark),
                         "nephroid::relative_error: the reference's mean is 0.000000, it must be positive",
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS((void)energy_error(two, negative),
                         "nephroid::energy_error: the reference's mean is -2.000000, it must be positive",
                         std::invalid_argument);
}

} // namespace nephroid::tests::error_test
