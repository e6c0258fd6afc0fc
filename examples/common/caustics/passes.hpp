// SPDX-License-Identifier: MIT
/// @file  One pass of a layer of light, or as many as bring the noise of their mean below an error.
#pragma once

#include "nephroid/emission/flux.hpp"
#include "nephroid/receiver/pass_variance.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace nephroid::examples {

/// The passes of a layer.
struct PassReport {
    std::uint64_t passes = 0; ///< whole ones
    /// The root mean square of the pixels' standard errors over their mean; nothing after one pass, or in the dark.
    std::optional<double> noise;
    bool is_interrupted = false;
};

/// A layer of light.
template <class Pixel>
struct PassedLayer {
    std::vector<Pixel> pixels;
    std::vector<float> variance; ///< of each pixel's power; empty after a single pass
    PassReport report;
};

/// Traces passes.
///
/// @param error      of the mean of passes, as a share of it: they go on until the noise is below; nothing: one pass
/// @param photons    of each pass
/// @param trace      trace(index of the first photon) -> photons emitted: fewer if the user interrupted
/// @param pixels_of  pixels_of() -> the sum of all passes in each pixel
template <class Trace, class PixelsOf>
[[nodiscard]] auto trace_passes(const std::optional<double>& error, std::uint64_t photons, const Trace& trace,
                                const PixelsOf& pixels_of) {
    using Pixel = typename decltype(pixels_of())::value_type;
    constexpr std::uint64_t least = 4; // fewer say too little of how they differ
    PassedLayer<Pixel> layer;
    PassReport& report = layer.report;
    std::vector<PassMoments> moments;
    const auto count_pass = [&] {
        const std::vector<Pixel> pixels = pixels_of();
        moments.resize(pixels.size());
        double light = 0, variance = 0;
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            moments[i].add(flux_traits<Pixel>::power(pixels[i]), report.passes);
            light += moments[i].mean(report.passes);
            variance += moments[i].variance_of_mean(report.passes);
        }
        if (report.passes > 1 && light > 0)
            report.noise = std::sqrt(variance * double(pixels.size())) / light;
    };
    std::uint64_t emitted = 0;
    do {
        const std::uint64_t of_pass = trace(report.passes * photons);
        emitted += of_pass;
        report.is_interrupted = of_pass < photons;
        if (!report.is_interrupted) {
            ++report.passes;
            if (error)
                count_pass();
        }
    } while (error && !report.is_interrupted && (report.passes < least || report.noise.value_or(0) > *error));

    layer.pixels = pixels_of();
    const float share = emitted > 0 ? float(double(photons) / double(emitted)) : 0; // fewer stand for all of the light
    for (Pixel& pixel : layer.pixels)
        pixel = pixel * share;
    if (report.passes > 1)
        for (const PassMoments& of_pixel : moments)
            layer.variance.push_back(float(of_pixel.variance_of_mean(report.passes)));
    return layer;
}

} // namespace nephroid::examples
