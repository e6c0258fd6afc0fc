// SPDX-License-Identifier: MIT
#include "common/study/gathering.hpp"

#include "common/stopwatch.hpp"
#include "common/study/bench.hpp"

#include "nephroid/gather/differential_map.hpp"
#include "nephroid/gather/diffusion.hpp"
#include "nephroid/gather/estimate_at.hpp"
#include "nephroid/gather/fixed_range.hpp"
#include "nephroid/gather/nearest_photons.hpp"
#include "nephroid/gather/progressive.hpp"
#include "nephroid/gather/trace_photons.hpp"

#include <cmath>
#include <numbers>

namespace nephroid::examples::study {

namespace {

using Map = PhotonMap<glm::vec3, float>;

/// Ghosts within this are enough for most of a sweep.
constexpr double margin_of_sweeps = 1.0 / 16;

/// Adds share * estimate(position, normal) to the vertices' pixels.
template <class E>
void add_to_picture(const Bench& bench, const E& estimate, double share, std::vector<float>& irradiance) {
    const float scale = static_cast<float>(share / bench.film().samples);
    estimate_at(bench.vertices(), &FloorVertex::position, upwards, estimate, bench.threads(),
                [&](std::size_t vertex, float e) { irradiance[bench.vertices()[vertex].pixel] += scale * e; });
}

/// Stores photons in a map and asks make_estimate(map) at each vertex.
/// @param reach  how far the estimate looks, for a periodic floor's ghosts
template <std::size_t N, class MakeEstimate>
[[nodiscard]] Estimate gather_from(const Bench& bench, Deposits<N> deposits, double reach, double trace_seconds,
                                   const MakeEstimate& make_estimate) {
    Deposits<N> photons = bench.with_ghosts(std::move(deposits), reach);
    Estimate result{std::vector<float>(bench.film().pixels()), {.trace = trace_seconds}};
    Stopwatch stopwatch;
    const Map map(photons);
    photons = {};
    const auto estimate = make_estimate(map);
    result.seconds.build = stopwatch.lap();
    add_to_picture(bench, estimate, 1, result.irradiance);
    result.seconds.estimate = stopwatch.lap();
    return result;
}

template <class MakeEstimate>
[[nodiscard]] Estimate gather(const Bench& bench, const Photons& photons, double reach, Source source,
                              const MakeEstimate& make_estimate) {
    if (source == Source::stored)
        return gather_from(bench, photons.deposits, reach, photons.bare_trace_seconds, make_estimate);
    Stopwatch stopwatch;
    Deposits<0> traced = bench.trace_bare(photons, 0, photons.emitted);
    const double seconds = stopwatch.lap();
    return gather_from(bench, std::move(traced), reach, seconds, make_estimate);
}

/// How far k photons reach where there are a quarter as many as on the film at large: darker places do not matter to a
/// picture's border.
[[nodiscard]] double reach_of(const Bench& bench, const Photons& photons, double count) {
    return 2 * std::sqrt(count / (std::numbers::pi * bench.density(photons)));
}

template <class K>
[[nodiscard]] Estimate nearest(const Bench& bench, const Photons& photons, double count, Source source, bool checked) {
    // Checking would follow what a pixel averages: nothing finer than the pixel, as the kernel sees it.
    const NearestPhotonsOptions options{.count = static_cast<std::size_t>(std::lround(count)),
                                        .differential_checking = checked,
                                        .checking = {.resolution = pixel_filter_width<K> * bench.film().pixel()}};
    return gather(bench, photons, reach_of(bench, photons, count), source,
                  [&](const Map& map) { return NearestPhotons(map, options, K{}); });
}

/// Photons with footprints of this smoothing.
[[nodiscard]] Deposits<2> with_footprints(const Bench& bench, const Photons& photons, double smoothing, Source source) {
    if (source == Source::stored) {
        Deposits<2> scaled = photons.deposits;
        for (auto& deposit : scaled)
            for (glm::vec3& tangent : deposit.d_position)
                tangent *= static_cast<float>(smoothing);
        return scaled;
    }
    const PhotonPass pass{.count = photons.emitted, .smoothing = smoothing, .limits = bench.limits()};
    return std::visit(
        [&](const auto& sequence) {
            return trace_photons(bench.scene().scene, bench.scene().light, pass, sequence, bench.threads()).deposits;
        },
        photons.samples);
}

/// Calls add(map, emitted in the pass, share of all) for the map of each pass's photons, whose fluxes are as if
/// there were no other passes.
template <class Add>
void for_each_pass(const Bench& bench, const Photons& photons, double reach, Source source, Seconds& seconds,
                   const Add& add) {
    for (std::size_t pass = 0; pass < photons.passes(); ++pass) {
        const std::uint64_t first = photons.first_of_pass(pass), end = photons.first_of_pass(pass + 1);
        const double share = double(end - first) / double(photons.emitted);
        const auto with = [&](auto deposits) {
            for (auto& deposit : deposits)
                deposit.flux *= static_cast<float>(1 / share);
            deposits = bench.with_ghosts(std::move(deposits), reach);
            Stopwatch stopwatch;
            const Map map(deposits);
            seconds.build += stopwatch.lap();
            add(map, end - first, share);
            seconds.estimate += stopwatch.lap();
        };
        Stopwatch stopwatch;
        if (source == Source::lamp) {
            auto traced = bench.trace_bare(photons, first, end);
            seconds.trace += stopwatch.lap();
            with(std::move(traced));
        } else {
            const auto begin = photons.deposits.begin();
            with(Deposits<2>(begin + std::ptrdiff_t(photons.pass_begin[pass]),
                             begin + std::ptrdiff_t(photons.pass_begin[pass + 1])));
        }
    }
    if (source == Source::stored)
        seconds.trace = photons.bare_trace_seconds;
}

} // namespace

Estimate gather_nearest(const Bench& bench, const Photons& photons, double count, Source source) {
    return nearest<BiweightKernel>(bench, photons, count, source, false);
}

Estimate gather_nearest_constant(const Bench& bench, const Photons& photons, double count, Source source) {
    return nearest<UniformKernel>(bench, photons, count, source, false);
}

Estimate gather_nearest_checked(const Bench& bench, const Photons& photons, double count, Source source) {
    return nearest<BiweightKernel>(bench, photons, count, source, true);
}

Estimate gather_differentials(const Bench& bench, const Photons& photons, double smoothing, Source source) {
    const FloorMap& floor = bench.map(0);
    Estimate result{std::vector<float>(bench.film().pixels()), {}};
    Stopwatch stopwatch;
    Deposits<2> deposits = with_footprints(bench, photons, smoothing, source);
    result.seconds.trace = source == Source::stored ? photons.trace_seconds : stopwatch.lap();
    const double reach = ghost_margin(bench.film(), smoothing, double(photons.emitted));
    deposits = bench.with_ghosts(std::move(deposits), reach);
    stopwatch = {};
    const DifferentialMap estimate(deposits, floor.map, Published{}, bench.threads());
    deposits = {};
    result.seconds.build = stopwatch.lap();
    add_to_picture(bench, estimate, 1, result.irradiance);
    result.seconds.estimate = stopwatch.lap();
    return result;
}

/// The edges of stored photons.
struct DiffusionSweep {
    DiffusionSweep(const Bench& bench, const Photons& photons, double reach_, const DiffusionOptions& options)
        : reach(reach_), map(bench.with_ghosts(photons.deposits, reach)),
          estimate(map, options, BiweightKernel{}, bench.threads()) {}

    double reach;
    Map map;
    DiffusionEstimate<glm::vec3, float> estimate; // refers to the map
};

Estimate gather_by_diffusion(const Bench& bench, const Photons& photons, double radius, double diffusivity,
                             Source source) {
    const DiffusionOptions options{.range = radius, .diffusivity = diffusivity};
    const double reach = radius + reach_of(bench, photons, double(options.gradient_count));
    if (source == Source::lamp)
        return gather(bench, photons, reach, source, [&](const Map& map) {
            return DiffusionEstimate(map, options, BiweightKernel{}, bench.threads());
        });
    std::shared_ptr<DiffusionSweep>& sweep = photons.diffusion;
    if (!sweep || (bench.scene().periodic && sweep->reach < reach))
        sweep = std::make_shared<DiffusionSweep>(bench, photons, (std::max)(reach, margin_of_sweeps), options);
    sweep->estimate.retune(options);
    Estimate result{std::vector<float>(bench.film().pixels()), {}};
    add_to_picture(bench, sweep->estimate, 1, result.irradiance);
    return result;
}

Estimate gather_progressively(const Bench& bench, const Photons& photons, double radius, Source source) {
    Estimate result{std::vector<float>(bench.film().pixels()), {}};
    ProgressivePhotonMapping<glm::vec3, float> progressive(bench.vertices(), &FloorVertex::position, upwards,
                                                           {.radius = radius});
    for_each_pass(bench, photons, radius, source, result.seconds, [&](const Map& map, std::uint64_t emitted, double) {
        progressive.add(map, emitted, bench.threads());
    });
    const float share = 1 / static_cast<float>(bench.film().samples);
    for (std::size_t vertex = 0; vertex < bench.vertices().size(); ++vertex)
        result.irradiance[bench.vertices()[vertex].pixel] += share * progressive.irradiance(vertex);
    return result;
}

Estimate gather_by_shrinking_radius(const Bench& bench, const Photons& photons, double radius, Source source) {
    Estimate result{std::vector<float>(bench.film().pixels()), {}};
    ShrinkingRadius shrinking({.radius = radius});
    for_each_pass(bench, photons, radius, source, result.seconds, [&](const Map& map, std::uint64_t, double share) {
        const FixedRange estimate(map, {.range = shrinking.radius()});
        add_to_picture(bench, estimate, share, result.irradiance);
        shrinking.advance();
    });
    return result;
}

} // namespace nephroid::examples::study
