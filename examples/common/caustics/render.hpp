// SPDX-License-Identifier: MIT
/// @file  From a scene, a light and an eye path map to sums at the vertices: the pilot pass and the real one, timed.
#pragma once

#include "common/caustics/progress.hpp"
#include "common/caustics/report.hpp"

#include "nephroid/emission/sequence/random.hpp"
#include "nephroid/emission/sequence/sobol.hpp"
#include "nephroid/estimate/caustics.hpp"

#include <chrono>
#include <cmath>
#include <stdexcept>
#include <variant>

namespace nephroid::examples {

/// Seconds since it was made or last asked.
class Stopwatch {
public:
    [[nodiscard]] double lap() {
        const auto now = Clock::now();
        return std::chrono::duration<double>(now - std::exchange(start_, now)).count();
    }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
};

/// Tells a pass's tracing from its splatting: `splat_caustics` calls its executor for the one and the other in turn.
class TimingExecutor {
public:
    explicit TimingExecutor(ThreadExecutor& threads) : threads_(&threads) {}

    template <class Task>
    void operator()(std::size_t count, Task&& task) {
        Stopwatch stopwatch;
        (*threads_)(count, std::forward<Task>(task));
        (is_tracing_ ? trace_ : splat_) += stopwatch.lap();
        is_tracing_ = !is_tracing_;
    }

    [[nodiscard]] double trace_seconds() const { return trace_; }
    [[nodiscard]] double splat_seconds() const { return splat_; }

private:
    ThreadExecutor* threads_;
    bool is_tracing_ = true;
    double trace_ = 0, splat_ = 0;
};

using AnySequence = std::variant<HaltonSequence, SobolSequence, RandomSequence>;
using AnyKernel = std::variant<BiweightKernel, EpanechnikovKernel, ConeKernel, UniformKernel, TruncatedGaussianKernel>;

[[nodiscard]] inline AnySequence make_sequence(const Options& options) {
    switch (options.sequence) {
    case SequenceKind::sobol:
        return SobolSequence(options.seed);
    case SequenceKind::random:
        return RandomSequence(options.seed);
    default:
        return HaltonSequence(options.seed);
    }
}

[[nodiscard]] inline AnyKernel make_kernel(const Options& options) {
    switch (options.kernel) {
    case KernelKind::epanechnikov:
        return EpanechnikovKernel{};
    case KernelKind::cone:
        return ConeKernel{};
    case KernelKind::uniform:
        return UniformKernel{};
    case KernelKind::gaussian:
        return TruncatedGaussianKernel{};
    default:
        return BiweightKernel{};
    }
}

/// The share of emitted photons that become caustic photons, from the first few thousand of the very sequence that
/// the picture is made with; more of them where caustics are rare.
/// Throws std::runtime_error if none of four million does.
template <class S, Light L, SampleSequence Sequence>
[[nodiscard]] double caustic_share(const S& scene, const L& light, const WalkLimits& limits, const Sequence& sequence,
                                   ThreadExecutor& threads) {
    constexpr std::size_t chunk = 1024, enough = 256, most = std::size_t(1) << 22;
    const Spread<scalar_t<typename L::vector>> spread{1, 1};
    std::size_t found = 0, tried = 0;
    for (std::size_t wanted = 4 * chunk; tried < most && found < enough; wanted *= 4) {
        std::vector<std::size_t> counts((wanted - tried) / chunk);
        threads(counts.size(), [&](std::size_t c) {
            Statistics unused;
            for (std::size_t i = tried + c * chunk; i < tried + (c + 1) * chunk; ++i) {
                Sampler<Sequence> sampler(sequence, i);
                const auto photon = light.emit(sampler, spread);
                counts[c] += walk(scene, photon, sampler, limits, unused).has_value();
            }
        });
        for (const std::size_t count : counts)
            found += count;
        tried = wanted;
    }
    if (found == 0)
        throw std::runtime_error("no photon of " + std::to_string(tried) +
                                 " reached a diffuse surface through a mirror or glass; is there a diffuse surface "
                                 "that the caustic falls on?");
    return double(found) / double(tried);
}

/// Traces and splats the photons that the options ask for and calls sink(vertex, irradiance) for every vertex.
template <Flux F, class S, Light L, Vector3 V, class Sink>
void splat_caustics_timed(const S& scene, const L& light, const EyePathMap<V>& map, const WalkLimits& limits,
                          const Options& options, ThreadExecutor& threads, Report& report, Sink&& sink) {
    std::visit(
        [&](const auto& kernel, const auto& sequence) {
            if (!(light.power() > 0))
                throw std::runtime_error("the lights emit nothing: their intensity or emission is zero");
            Stopwatch stopwatch;
            std::uint64_t emit = options.emit.value_or(0);
            if (emit == 0) {
                const double share = caustic_share(scene, light, limits, sequence, threads);
                const double wanted = std::ceil(double(options.photons) / share);
                if (!(wanted < 1e18))
                    throw std::runtime_error("--photons: too many; only one photon in " +
                                             std::to_string(std::lround(1 / share)) + " makes a caustic here");
                emit = static_cast<std::uint64_t>(wanted);
            }
            report.seconds.pilot += stopwatch.lap();

            using Policies = SplatPolicies<std::remove_cvref_t<decltype(kernel)>>;
            PhotonSplatter<V, F, Policies> splatter(map, Policies{.filter = {options.pixel_filter ? 1.0 : 0.0}});
            TimingExecutor timing(threads);
            Progress progress(emit);
            const PhotonPass pass{.count = emit,
                                  .smoothing = options.smoothing,
                                  .limits = limits,
                                  .progress = [&](std::uint64_t done) {
                                      progress.show(done);
                                      return true;
                                  }};
            report.statistics = splat_caustics(scene, light, splatter, pass, sequence, timing);
            report.seconds.trace += timing.trace_seconds();
            report.seconds.splat += timing.splat_seconds();
            splatter.for_each(sink);
        },
        make_kernel(options), make_sequence(options));
}

} // namespace nephroid::examples
