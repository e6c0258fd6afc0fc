// SPDX-License-Identifier: MIT
/// @file  One pass of a layer of light, or as many as bring the noise of their mean below an error.
#pragma once

#include "common/caustics/interrupt.hpp"
#include "common/caustics/progress.hpp"

#include "nephroid/emission/flux.hpp"
#include "nephroid/receiver/pass_variance.hpp"
#include "nephroid/transport/account.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <vector>

namespace nephroid::examples {

/// The passes of a layer.
struct PassReport {
    std::uint64_t passes = 0; ///< whole ones
    /// Of the mean of several passes, over all pixels (RelativeNoise); infinite if all of them are dark.
    std::optional<double> noise;
    bool is_interrupted = false;
};

/// A layer of light.
template <class Pixel>
struct PassedLayer {
    std::vector<Pixel> pixels;   ///< the mean of the passes
    std::vector<float> variance; ///< of each pixel's power; empty after a single pass
    PassReport report;
};

/// Traces passes, one after another. At least four of several, as fewer say too little of how they differ; no more than
/// four if all of them are dark, and than 64 if a single one is not: its noise stays the whole of its light however
/// many dark ones follow.
///
/// @param error      of the mean of passes, as a share of it: they go on until the noise is below; nothing: one pass
/// @param photons    of each pass
/// @param trace      trace(index of the first photon, progress) -> photons emitted: fewer if the user interrupted. The
///                   library calls progress(photons so far), which shows them and is false after an interrupt
/// @param pixels_of  pixels_of() -> the pixels of the pass that was traced last
template <class Trace, class PixelsOf>
[[nodiscard]] auto trace_passes(const std::optional<double>& error, std::uint64_t photons, const Trace& trace,
                                const PixelsOf& pixels_of) {
    using Pixel = typename std::invoke_result_t<const PixelsOf&>::value_type;
    constexpr std::uint64_t least = 4, most_of_one_lit = 64;
    PassedLayer<Pixel> layer;
    PassReport& report = layer.report;
    std::vector<PassMoments> moments;
    std::uint64_t lit_passes = 0;
    // Adds a pass, or a part of one, to the mean.
    const auto add = [&](const std::vector<Pixel>& pass, double part) {
        if (layer.pixels.empty())
            layer.pixels.assign(pass.size(), flux_traits<Pixel>::zero());
        const double passes = double(report.passes) + part;
        const auto kept = float(double(report.passes) / passes), share = float(1 / passes);
        for (std::size_t i = 0; i < pass.size(); ++i)
            layer.pixels[i] = report.passes > 0 ? layer.pixels[i] * kept + pass[i] * share : pass[i] * share;
    };
    const auto count = [&](const std::vector<Pixel>& pass) {
        moments.resize(pass.size());
        RelativeNoise noise;
        bool is_lit = false;
        for (std::size_t i = 0; i < pass.size(); ++i) {
            const double power = flux_traits<Pixel>::power(pass[i]);
            is_lit = is_lit || power != 0;
            moments[i].add(power, report.passes);
            noise.add(moments[i].mean, moments[i].variance_of_mean(report.passes));
        }
        lit_passes += is_lit ? 1 : 0;
        if (report.passes > 1)
            report.noise = noise.value();
    };
    const auto must_go_on = [&] {
        if (report.passes < least)
            return true;
        const bool is_doubtful = lit_passes == 1 && report.passes >= most_of_one_lit;
        return std::isfinite(*report.noise) && *report.noise > *error && !is_doubtful;
    };
    do {
        Progress bar(photons);
        const std::uint64_t emitted = trace(report.passes * photons, [&bar](std::uint64_t done) {
            bar.show(done);
            return !is_interrupted();
        });
        const std::vector<Pixel> pass = pixels_of();
        add(pass, emitted > 0 ? double(emitted) / double(photons) : 1); // fewer stand for all of the light
        // A pass of one batch is whole although the user interrupted it.
        report.is_interrupted = emitted < photons || (error && is_interrupted());
        if (emitted == photons) {
            ++report.passes;
            if (error)
                count(pass);
        }
    } while (error && !report.is_interrupted && must_go_on());
    if (report.passes > 1)
        for (const PassMoments& pixel : moments)
            layer.variance.push_back(float(pixel.variance_of_mean(report.passes)));
    return layer;
}

/// Makes the fluxes of an account those of one pass; the numbers of photons stay those of all.
inline void divide_flux(Statistics& account, std::uint64_t passes) {
    const double share = passes > 1 ? 1 / double(passes) : 1;
    const auto divide = [share](Tally& tally) {
        tally.flux *= share;
        tally.excess *= share;
    };
    divide(account.emitted);
    for (Tally& tally : account.fates)
        divide(tally);
    for (Tally& tally : account.received)
        divide(tally);
}

} // namespace nephroid::examples
