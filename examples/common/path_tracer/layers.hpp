// SPDX-License-Identifier: MIT
/// @file  Path traces what eye vertices see, by layers of light, with a standard error for each pixel.
#pragma once

#include "common/path_tracer/bounced_paths.hpp"

#include "nephroid/execution/executor.hpp"
#include "nephroid/sequence/random.hpp"
#include "nephroid/sequence/sequence.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <type_traits>
#include <vector>

namespace nephroid::examples {

struct LayerTraceOptions {
    std::uint64_t samples = 256;                              ///< paths from each vertex, >= 2
    double seconds = std::numeric_limits<double>::infinity(); ///< no further round of 16 paths begins after this time
    unsigned bounces = all_bounces;                           ///< off diffuse surfaces before the one that is seen
    std::uint64_t seed = 0;
};

/// Irradiance at the vertices times their weights, added up by pixel.
template <Flux F>
struct TracedLayers {
    std::vector<LightLayers<F>> mean;
    std::vector<LightLayers<F>> standard_error; ///< of the mean for these vertices, from how much paths differ
    std::vector<F> sum_error;                   ///< the same of the sum of all three layers
    std::uint64_t samples = 0;                  ///< paths from each vertex
};

namespace detail {

/// A mean and the sum of squared deviations from it.
/// Source: Welford 1962, "Note on a method for calculating corrected sums of squares and products".
template <Flux F>
struct RunningMean {
    F mean = flux_traits<F>::zero(), squares = flux_traits<F>::zero();

    /// @param n  how many there are with this one
    void add(const F& value, double n) {
        const F before = value + mean * grey<F>(-1);
        mean = mean + before * grey<F>(1 / n);
        squares = squares + before * (value + mean * grey<F>(-1));
    }
    [[nodiscard]] F standard_error(double n) const {
        return by_band([n](auto s) { return decltype(s)(std::sqrt(s / decltype(s)(n * (n - 1)))); }, squares);
    }
};

/// A film whose paths are traced in rounds.
template <class T, Flux F>
class LayerTracer {
public:
    LayerTracer(const Scene<T, F>& scene, const Lamps<T, F>& lamps, const std::vector<EyeVertex<T, F>>& vertices,
                std::size_t pixels, const LayerTraceOptions& options)
        : vertices_(vertices), options_(options), paths_(scene, lamps, options.bounces), pixels_(pixels) {
        const auto by_pixel = [](const EyeVertex<T, F>& a, const EyeVertex<T, F>& b) { return a.pixel < b.pixel; };
        if (!std::is_sorted(vertices.begin(), vertices.end(), by_pixel) ||
            (!vertices.empty() && vertices.back().pixel >= pixels))
            invalid_argument("path_trace_layers: the vertices are not in the order of the film's pixels");
        if (options.samples < 2)
            invalid_argument("path_trace_layers: fewer than 2 samples tell no standard error");
    }

    [[nodiscard]] std::uint64_t samples() const { return samples_; }

    template <Executor E>
    void trace(std::uint64_t paths, E& executor) {
        constexpr std::size_t chunk = 16; // pixels
        executor((pixels_.size() + chunk - 1) / chunk, [&](std::size_t part) {
            for (std::size_t i = part * chunk; i < (std::min)(pixels_.size(), (part + 1) * chunk); ++i)
                trace(i, paths);
        });
        samples_ += paths;
    }

    [[nodiscard]] TracedLayers<F> result() const {
        TracedLayers<F> result;
        result.samples = samples_;
        const double n = double(samples_);
        for (const Pixel& p : pixels_) {
            result.mean.push_back({p.direct.mean, p.caustic.mean, p.indirect.mean});
            result.standard_error.push_back(
                {p.direct.standard_error(n), p.caustic.standard_error(n), p.indirect.standard_error(n)});
            result.sum_error.push_back(p.sum.standard_error(n));
        }
        return result;
    }

private:
    struct Pixel {
        RunningMean<F> direct, caustic, indirect, sum;
    };

    void trace(std::size_t pixel, std::uint64_t paths) {
        const std::size_t first = first_vertex(pixel), last = first_vertex(pixel + 1);
        std::vector<Medium> media;
        for (std::size_t i = first; i < last; ++i)
            media.push_back(paths_.medium_at(vertices_[i]));
        Pixel& p = pixels_[pixel];
        for (std::uint64_t path = samples_; path < samples_ + paths && first < last; ++path) {
            LightLayers<F> now;
            for (std::size_t i = first; i < last; ++i) {
                const RandomSequence numbers(hash_bits(options_.seed, i));
                Sampler<RandomSequence> sampler(numbers, path);
                const F weight = vertices_[i].weight * vertices_[i].diffuse_share;
                now = now + paths_(vertices_[i], media[i - first], sampler) * weight;
            }
            const double n = double(path + 1);
            p.direct.add(now.direct, n);
            p.caustic.add(now.caustic, n);
            p.indirect.add(now.indirect, n);
            p.sum.add(now.sum(), n);
        }
    }

    [[nodiscard]] std::size_t first_vertex(std::size_t pixel) const {
        const auto before = [](const EyeVertex<T, F>& v, std::size_t bound) { return v.pixel < bound; };
        return std::size_t(std::lower_bound(vertices_.begin(), vertices_.end(), pixel, before) - vertices_.begin());
    }

    const std::vector<EyeVertex<T, F>>& vertices_;
    const LayerTraceOptions& options_;
    BouncedPaths<T, F> paths_;
    std::vector<Pixel> pixels_;
    std::uint64_t samples_ = 0; ///< paths from each vertex so far
};

} // namespace detail

/// Called with the layers so far after each round, from the calling thread; false ends the work.
template <Flux F>
using LayerProgress = std::function<bool(const TracedLayers<F>&)>;

/// Path traces the light at the vertices of a film. An estimate of a pixel is one path from each of its vertices; the
/// standard error comes from how much such estimates differ. Where light is rare, as that of a small lamp behind glass,
/// the standard error is as rough as the mean.
///
/// The result is the same bit for bit for any number of threads. Throws what `BouncedPaths` does, and
/// std::invalid_argument for fewer than two samples and for vertices that are not in the order of their pixels.
///
/// @param pixels  of the film; those without vertices are dark
template <class T, Flux F, Executor E>
[[nodiscard]] TracedLayers<F> path_trace_layers(const Scene<T, F>& scene, const Lamps<T, F>& lamps,
                                                const std::vector<EyeVertex<T, F>>& vertices, std::size_t pixels,
                                                const LayerTraceOptions& options, E&& executor,
                                                const std::type_identity_t<LayerProgress<F>>& progress = {}) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point start = Clock::now();
    const auto seconds = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
    detail::LayerTracer<T, F> tracer(scene, lamps, vertices, pixels, options);
    do {
        constexpr std::uint64_t round = 16;
        tracer.trace((std::min)(options.samples - tracer.samples(), round), executor);
    } while ((!progress || progress(tracer.result())) && tracer.samples() < options.samples &&
             seconds() < options.seconds);
    return tracer.result();
}

} // namespace nephroid::examples
