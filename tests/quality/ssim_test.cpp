// SPDX-License-Identifier: MIT
#include "quality/pictures.hpp"

#include "nephroid/quality/ssim.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <vector>

namespace nephroid::tests::ssim_test {

namespace {

/// The definition, word for word: a two-dimensional window, central moments, long double, O(pixels * window^2).
template <class A, class B>
long double ssim_by_definition(const std::vector<A>& a, const std::vector<B>& b, std::size_t width, std::size_t height,
                               const SsimOptions& options = {}) {
    const std::size_t n = options.window;
    const long double sigma = options.sigma, middle = (static_cast<long double>(n) - 1) / 2;
    const long double range = options.dynamic_range;
    const long double c1 = std::pow(options.k1 * range, 2.0L), c2 = std::pow(options.k2 * range, 2.0L);

    std::vector<long double> weights(n * n);
    long double total = 0;
    for (std::size_t j = 0; j < n; ++j)
        for (std::size_t i = 0; i < n; ++i) {
            const long double dx = static_cast<long double>(i) - middle, dy = static_cast<long double>(j) - middle;
            total += weights[j * n + i] = std::exp(-(dx * dx + dy * dy) / (2 * sigma * sigma));
        }

    const auto mean = [&](std::size_t x, std::size_t y, auto value) {
        long double sum = 0;
        for (std::size_t j = 0; j < n; ++j)
            for (std::size_t i = 0; i < n; ++i)
                sum += weights[j * n + i] * value((y + j) * width + x + i);
        return sum / total;
    };
    long double sum = 0, count = 0;
    for (std::size_t y = 0; y + n <= height; ++y)
        for (std::size_t x = 0; x + n <= width; ++x) {
            const long double mu_a = mean(x, y, [&](std::size_t p) { return static_cast<long double>(a[p]); });
            const long double mu_b = mean(x, y, [&](std::size_t p) { return static_cast<long double>(b[p]); });
            const long double var_a = mean(x, y, [&](std::size_t p) { return (a[p] - mu_a) * (a[p] - mu_a); });
            const long double var_b = mean(x, y, [&](std::size_t p) { return (b[p] - mu_b) * (b[p] - mu_b); });
            const long double covariance = mean(x, y, [&](std::size_t p) { return (a[p] - mu_a) * (b[p] - mu_b); });
            sum += (2 * mu_a * mu_b + c1) * (2 * covariance + c2) /
                   ((mu_a * mu_a + mu_b * mu_b + c1) * (var_a + var_b + c2));
            ++count;
        }
    return sum / count;
}

/// A moment of pixels in [0, 1] is a sum of 2 * 11 rounded products, so it is known to about 25 epsilon; four of them
/// make a factor, whose denominator is at least C1 = 1e-4.
constexpr double tolerance = 100 * std::numeric_limits<double>::epsilon() / 1e-4; // 2.2e-10

} // namespace

TEST_CASE("ssim: agrees with its definition on noise, for float and for double pixels") {
    const std::size_t width = 23, height = 17;
    const std::vector<float> a = tests::noise_picture(width, height, 1), noise = tests::noise_picture(width, height, 2);
    std::vector<double> b; // correlated with a, darker, noisier
    for (std::size_t i = 0; i < a.size(); ++i)
        b.push_back(0.6 * a[i] + 0.3 * noise[i]);

    const double found = ssim(a, b, width, height);
    CHECK(std::abs(found - static_cast<double>(ssim_by_definition(a, b, width, height))) <= tolerance);
    CHECK(found > 0.5);
    CHECK(found < 0.9);
}

TEST_CASE("ssim: agrees with its definition for every parameter, odd and even windows, and a single window") {
    const std::size_t width = 14, height = 12;
    const std::vector<float> a = tests::noise_picture(width, height, 3), b = tests::noise_picture(width, height, 4);
    for (const SsimOptions& options :
         {SsimOptions{.window = 1}, SsimOptions{.window = 8, .sigma = 2.5}, SsimOptions{.window = 12},
          SsimOptions{.k1 = 0.2}, SsimOptions{.k2 = 0.2}, SsimOptions{.dynamic_range = 2.5}}) {
        const double expected = static_cast<double>(ssim_by_definition(a, b, width, height, options));
        CHECK(std::abs(ssim(a, b, width, height, options) - expected) <= tolerance);
    }
    const std::vector<float> small_a = tests::noise_picture(11, 11, 3), small_b = tests::noise_picture(11, 11, 4);
    CHECK(std::abs(ssim(small_a, small_b, 11, 11) -
                   static_cast<double>(ssim_by_definition(small_a, small_b, 11, 11))) <= tolerance);
}

// No contrast: the second factor is C2 / C2.
TEST_CASE("ssim: two flat images differ by their means alone") {
    const std::vector<double> a(20 * 15, 0.75), b(20 * 15, 0.25);
    const double expected = (2 * 0.75 * 0.25 + 1e-4) / (0.75 * 0.75 + 0.25 * 0.25 + 1e-4);
    CHECK(std::abs(ssim(a, b, 20, 15) - expected) <= tolerance);
}

// The window is symmetric, so its mean of a ramp is the ramp at its middle; a shift keeps variance and covariance.
TEST_CASE("ssim: a ramp and its shifted copy differ by the mean at each window's middle") {
    const std::size_t width = 33, height = 12;
    const double slope = 1.0 / 64, shift = 0.25;
    std::vector<double> ramp, shifted;
    for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; ++x) {
            ramp.push_back(slope * static_cast<double>(x));
            shifted.push_back(ramp.back() + shift);
        }
    double expected = 0;
    for (std::size_t x = 5; x < width - 5; ++x) {
        const double mu = slope * static_cast<double>(x);
        expected += (2 * mu * (mu + shift) + 1e-4) / (mu * mu + (mu + shift) * (mu + shift) + 1e-4);
    }
    expected /= static_cast<double>(width - 10);
    CHECK(std::abs(ssim(ramp, shifted, width, height) - expected) <= tolerance);
}

TEST_CASE("ssim: is 1 for equal images, symmetric, and negative for a negative") {
    const std::vector<float> a = tests::noise_picture(24, 24, 5), b = tests::noise_picture(24, 24, 6);
    std::vector<float> negative;
    for (const float pixel : a)
        negative.push_back(1 - pixel);
    CHECK(std::abs(ssim(a, a, 24, 24) - 1) <= tolerance);
    CHECK(std::abs(ssim(a, b, 24, 24) - ssim(b, a, 24, 24)) <= tolerance);
    CHECK(ssim(a, negative, 24, 24) < -0.9);
}

// Width and height exchanged on both images reads other rows: only a transposed *image* gives the same value.
TEST_CASE("ssim: rows are rows: transposing both images changes nothing") {
    const std::size_t width = 21, height = 13;
    const std::vector<float> a = tests::noise_picture(width, height, 7), b = tests::noise_picture(width, height, 8);
    const auto transposed = [&](const std::vector<float>& image) {
        std::vector<float> result(image.size());
        for (std::size_t y = 0; y < height; ++y)
            for (std::size_t x = 0; x < width; ++x)
                result[x * height + y] = image[y * width + x];
        return result;
    };
    const double found = ssim(a, b, width, height);
    CHECK(std::abs(ssim(transposed(a), transposed(b), height, width) - found) <= tolerance);
    CHECK(std::abs(ssim(a, b, height, width) - found) > 1e-6);
}

// Squares of 1e6 are known to 1e12 epsilon = 2e-4 only, a fifth of C2; moments about the mean keep every digit.
TEST_CASE("ssim: a large offset does not drown a small texture") {
    const std::size_t width = 16, height = 16;
    std::vector<double> a, b;
    for (const float pixel : tests::noise_picture(width, height, 9))
        a.push_back(1e6 + pixel / 16.0);
    for (const float pixel : tests::noise_picture(width, height, 10))
        b.push_back(1e6 + pixel / 16.0);
    const double expected = static_cast<double>(ssim_by_definition(a, b, width, height));
    CHECK(std::abs(ssim(a, b, width, height) - expected) <= 1e-7); // pixels are rounded to 1e-10, C2 is 9e-4
}

TEST_CASE("ssim: a wrong call is refused with the value that is wrong") {
    const std::vector<double> image(12 * 10, 0.5), other(11 * 11, 0.5);
    CHECK_THROWS_WITH_AS((void)ssim(image, other, 12, 10), "nephroid::ssim: image has 120 pixels, reference has 121",
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS((void)ssim(other, other, 12, 10), "nephroid::ssim: image has 121 pixels, which is not 12 x 10",
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS((void)ssim(other, other, 0, 0), "nephroid::ssim: image has 121 pixels, which is not 0 x 0",
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS((void)ssim(image, image, 12, 10),
                         "nephroid::ssim: no window of 11 pixels a side lies inside an image of 12 x 10",
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS((void)ssim(other, other, 11, 11, {.window = 0}),
                         "nephroid::ssim: no window of 0 pixels a side lies inside an image of 11 x 11",
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS((void)ssim(other, other, 11, 11, {.sigma = 0}),
                         "nephroid::ssim: sigma is 0.000000, it must be positive and finite", std::invalid_argument);
    CHECK_THROWS_WITH_AS((void)ssim(other, other, 11, 11, {.dynamic_range = -1}),
                         "nephroid::ssim: dynamic_range is -1.000000, it must be positive and finite",
                         std::invalid_argument);
    CHECK_THROWS_AS((void)ssim(other, other, 11, 11, {.k1 = 0}), std::invalid_argument);
    CHECK_THROWS_AS((void)ssim(other, other, 11, 11, {.k2 = std::numeric_limits<double>::infinity()}),
                    std::invalid_argument);

    std::vector<double> undefined = other;
    undefined[60] = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH_AS((void)ssim(undefined, other, 11, 11),
                         "nephroid::ssim: image pixel 60 is nan, every pixel must be finite", std::invalid_argument);
}

} // namespace nephroid::tests::ssim_test
