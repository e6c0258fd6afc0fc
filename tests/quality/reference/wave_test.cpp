// SPDX-License-Identifier: MIT
#include "nephroid/execution/thread_executor.hpp"
#include "nephroid/quality/reference/wave.hpp"
#include "quality/reference/compare.hpp"

#include <doctest/doctest.h>

namespace nephroid::reference::wave_test {

namespace {

constexpr Wave focused{.amplitude = 0.04, .fresnel = false}, focused_fresnel{.amplitude = 0.04, .fresnel = true};
constexpr Wave prefocal{.amplitude = 0.012, .fresnel = false}, prefocal_fresnel{.amplitude = 0.012, .fresnel = true};

/// Where the light that enters above (x, y) lands: three-dimensional, by Snell's law for vectors.
Vector land(const Wave& wave, double x, double y, double& flux) {
    const double phase = 2 * std::numbers::pi * (2 * x + y),
                 slope = 2 * std::numbers::pi * wave.amplitude * std::cos(phase);
    const Vector tilted{-2 * slope, -slope, 1};
    const double z = 1 + wave.amplitude * std::sin(phase);
    double passed = 1;
    const Vector d = refract({0, 0, -1}, 1 / std::sqrt(dot(tilted, tilted)) * tilted, 1 / 1.33, passed);
    flux *= wave.fresnel ? passed : 1;
    return Vector{x, y, z} + -z / d.z * d;
}

} // namespace

TEST_CASE("reference wave: the mean irradiance is 1 without Fresnel loss and the known transmittance with it") {
    CHECK(std::abs(wave_mean(focused) - 1) < 1e-14);
    CHECK(std::abs(wave_mean(focused_fresnel) - 0.97957598) < 5e-9); // half a unit of the last digit
    CHECK(std::abs(wave_mean(prefocal_fresnel) - 0.97993743) < 5e-9);
    for (const Wave& w : {focused, focused_fresnel, prefocal, prefocal_fresnel})
        for (const int n : {16, 17, 128}) // per pixel 2e-16 of 2x + y up to 3, over a step of 1/128
            CHECK(std::abs(mean(wave(w, {0, 1, 0, 1, n, n})) / wave_mean(w) - 1) < 1e-12);
}

TEST_CASE("reference wave: before the focus the irradiance spans the known range") {
    const Image image = wave(prefocal, {0, 1, 0, 1, 512, 512});
    const auto [least, most] = std::minmax_element(image.begin(), image.end());
    CHECK(std::abs(*least - 0.633) < 5e-4);
    CHECK(std::abs(*most - 2.467) < 5e-4);
}

TEST_CASE("reference wave: a still surface lights the floor evenly") {
    for (const double pixel : wave({.amplitude = 0, .fresnel = false}, {-3, 2.5, 0.1, 9, 7, 5}))
        CHECK(std::abs(pixel - 1) < 1e-12);
    const double normal = 4 * 1.33 / (2.33 * 2.33);
    for (const double pixel : wave({.amplitude = 0, .fresnel = true}, {0, 1, 0, 1, 3, 3}))
        CHECK(std::abs(pixel - normal) < 1e-12);
}

// A pixel's share of N evenly spread rays is off by those near its outline, of the order of sqrt(N) in the worst case,
// here 1000 of the 15625 per pixel and in practice 20 times fewer.
TEST_CASE("reference wave: a million refracted rays land as computed") {
    const Film film{0, 1, 0, 1, 8, 8};
    for (const Wave& w : {focused, focused_fresnel, prefocal_fresnel}) {
        Image image(64);
        constexpr int n = 1'000'000;
        for (int i = 0; i < n; ++i) {
            const LatticePoint p(i);
            double flux = 1.0 / n;
            const Vector at = land(w, p.u, p.v, flux);
            add_flux(image, film, at.x - std::floor(at.x), at.y - std::floor(at.y), flux);
        }
        CHECK(worst_difference(image, wave(w, film)) < 4e-3);
    }
}

// The trapezium rule over a period: kinks at h = 1e-6 in a density that rises over 0.01 cost (h/0.01)^2 / 12 = 1e-9 at
// most, but where the map folds, dt = sqrt(0.01 / 40), less.
TEST_CASE("reference wave: single pixels agree with a dense sum over the surface") {
    const Film film{0.3, 0.31, 0.2, 0.22, 1, 1}; // 2x + y spans 0.8 to 0.84
    for (const Wave& w : {focused_fresnel, prefocal})
        for (const double shift : {0.0, 0.05, 0.13, 0.21, 0.37, 0.44, 0.5, 0.62}) {
            constexpr int n = 1'000'000;
            double sum = 0;
            for (int i = -n; i < 2 * n; i += 1) {
                double flux = 1;
                const double t = (i + 0.5) / n;
                if (std::abs(t - 0.82 - shift) > 0.6)
                    continue; // the light moves 2x + y by less than 0.5
                const Vector at = land(w, 0, t, flux);
                const double v = 2 * at.x + at.y - 0.8 - shift; // both sides add 0.02: the density is a triangle
                sum += flux * (std::max)(0.0, (std::min)(v, 0.04 - v)) / (0.02 * 0.02) / n;
            }
            const Image pixel = wave(w, {film.x_min, film.x_max, film.y_min + shift, film.y_max + shift, 1, 1});
            CHECK(std::abs(pixel[0] / sum - 1) < 1e-8);
        }
}

// A pixel is a quotient of differences of 2x + y, which carry about 2e-16: over a pixel's 1/96 that is 2e-14, and 10
// times that at a fold.
TEST_CASE("reference wave: a pixel is the mean of the pixels it is cut into, on any film") {
    for (const Wave& w : {focused, focused_fresnel, prefocal, Wave{.amplitude = 0.1, .fresnel = true}})
        for (const Film& film :
             {Film{0, 1, 0, 1, 32, 32}, Film{-0.31, 1.77, 0.2, 0.9, 20, 31}, Film{0, 20, 0, 30, 4, 5}}) {
            const Film fine{film.x_min, film.x_max, film.y_min, film.y_max, 3 * film.width, 3 * film.height};
            CHECK(worst_difference(averaged(wave(w, fine), fine, 3), wave(w, film)) < 2e-12);
        }
}

TEST_CASE("reference wave: films with and without pixels alike give the same pixels") {
    const Image alike = wave(focused, {0, 1, 0, 1, 24, 24}); // 2 : 1, computed once per kind
    const Image each = wave(focused, {0, std::nextafter(1.0, 2.0) + 1e-12, 0, 1, 24, 24});
    CHECK(worst_difference(each, alike) < 1e-9); // the film differs by 1e-12 of a size, pixels of 1/24
    CHECK(alike[3 + 24 * 2] == alike[2 + 24 * 4]);
    const Image period = wave(focused, {1, 2, -2, -1, 24, 24});
    CHECK(worst_difference(period, alike) < 1e-12);
}

TEST_CASE("reference wave: the number of threads does not change a bit") {
    for (const Film& film : {Film{0, 1, 0, 1, 64, 64}, Film{0, 1.234567, 0, 1, 40, 41}})
        CHECK(wave(focused_fresnel, film, nephroid::SerialExecutor()) ==
              wave(focused_fresnel, film, nephroid::ThreadExecutor(5)));
}

} // namespace nephroid::reference::wave_test
