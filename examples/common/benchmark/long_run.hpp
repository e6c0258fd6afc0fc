// SPDX-License-Identifier: MIT
/// @file  A long run: whether the error of very many photons falls with their number as expected.
#pragma once

#include "common/benchmark/passes.hpp"

namespace nephroid::examples::benchmarks {

/// A picture without noise, and the variance of one made of N random photons, for footprints that are the pixel
/// filter alone: E and E/N seen through the kernel and through its square.
struct Expectation {
    double value = 0, variance = 0;
};

/// @param exact  irradiance on cells, `fine` of them along a pixel's side; it repeats beyond its borders
[[nodiscard]] inline Expectation expect_at(const std::vector<double>& exact, long cells, double fine, double x,
                                           double y, double photons) {
    const double radius = pixel_filter_width<BiweightKernel> * fine, weight = 1 / (radius * radius);
    Expectation expected;
    for (long j = long(std::floor(y - radius)); double(j) <= y + radius; ++j)
        for (long i = long(std::floor(x - radius)); double(i) <= x + radius; ++i) {
            const double r2 = weight * (square(double(i) + 0.5 - x) + square(double(j) + 0.5 - y));
            const double k = weight * BiweightKernel{}(r2);
            const double e = exact[std::size_t((j + cells) % cells * cells + (i + cells) % cells)];
            expected.value += e * k;
            expected.variance += e * k * k * double(cells) * double(cells) / photons;
        }
    return expected;
}

/// Random photons on wave-focused, 256 x 256, two threads.
inline void benchmark_long_run(const Effort& effort) {
    constexpr std::size_t side = 256, fine = 32; // cells per pixel: with 8 the expectation itself is 0.0027 off
    const auto builtin = builtin_case<float, float>("wave-focused", false).value();
    BuiltinFilm film{.scene = "wave-focused", .view = builtin.film, .width = side, .height = side};
    const auto vertices = floor_vertices(film, 1.0 / 16);
    const EyePathMap map(vertices, &FloorVertex::position, upwards);
    ThreadExecutor threads(2);
    BuiltinFilm cells = film;
    cells.width = cells.height = side * fine;
    const std::vector<double> exact = exact_picture(cells, 2).value();

    auto sums = nephroid::sums<float>(map);
    const MemoryPeak memory;
    Stopwatch stopwatch;
    const Statistics account = splat_caustics(builtin.scene, builtin.light, sums,
                                              {.count = effort.photons, .smoothing = 1, .limits = walk_limits(film)},
                                              RandomSequence(5), threads);
    const double seconds = stopwatch.lap(), photons = double(effort.photons);
    std::vector<double> picture(side * side);
    sums.for_each([&](std::size_t vertex, float e) { picture[vertices[vertex].pixel] += double(e); });
    double error2 = 0, variance = 0;
    for (std::size_t pixel = 0; pixel < picture.size(); ++pixel) {
        const auto centre = [](std::size_t i) { return (double(i) + 0.5) * double(fine); };
        const Expectation expected =
            expect_at(exact, long(side * fine), double(fine), centre(pixel % side), centre(pixel / side), photons);
        error2 += square(picture[pixel] - expected.value);
        variance += expected.variance;
    }
    std::array<char, 100> what{};
    std::snprintf(what.data(), what.size(), "long run, %.0e photons: error, %.0f MiB", photons,
                  memory.bytes().value_or(0) / (1 << 20));
    print_row(what.data(), std::sqrt(error2 / double(side * side)), "rms", "what their number says",
              std::sqrt(error2 / variance), photons > 1e7 ? Bar::at_most(1.02) : Bar{});
    print_row("  flux lost, of what was emitted", std::abs(account.accounted_flux() / account.emitted.flux - 1), "",
              "none", no_ratio);
    print_row("  in", seconds, "s", "", no_ratio);
}

} // namespace nephroid::examples::benchmarks
