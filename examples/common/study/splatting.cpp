// SPDX-License-Identifier: MIT
#include "common/study/splatting.hpp"

#include "common/stopwatch.hpp"
#include "common/study/bench.hpp"

#include "nephroid/caustics.hpp"
#include "nephroid/gather/progressive.hpp"
#include "nephroid/splat/splat_photons.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace nephroid::examples::study {

namespace {

/// Photons [first, end) of those emitted, with footprints of this smoothing among all.
struct PassOfPhotons {
    std::uint64_t first, end; ///< as emitted
    std::size_t deposit, deposit_end;
    std::optional<double> smoothing; ///< nothing: the library chooses
};

[[nodiscard]] PassOfPhotons whole(const Photons& photons, std::optional<double> smoothing) {
    return {0, photons.emitted, 0, photons.deposits.size(), smoothing};
}

/// A smoothing is relative to the number of photons: among all, a pass's is as much larger as they are more.
[[nodiscard]] std::vector<PassOfPhotons> shrinking_passes(const Photons& photons, double smoothing) {
    std::vector<PassOfPhotons> passes;
    ShrinkingRadius shrinking({.radius = smoothing});
    for (std::size_t pass = 0; pass < photons.passes(); ++pass, shrinking.advance()) {
        const std::uint64_t first = photons.first_of_pass(pass), end = photons.first_of_pass(pass + 1);
        const double among_all = shrinking.radius() * std::sqrt(double(photons.emitted) / double(end - first));
        passes.push_back({first, end, photons.pass_begin[pass], photons.pass_begin[pass + 1], among_all});
    }
    return passes;
}

[[nodiscard]] std::vector<float> picture(const Bench& bench, const FloorMap& floor,
                                         const Sums<glm::vec3, float>& sums) {
    std::vector<float> irradiance(bench.film().pixels());
    const float share = 1 / static_cast<float>(bench.film().samples);
    sums.for_each([&](std::size_t vertex, float e) { irradiance[floor.vertices[vertex].pixel] += share * e; });
    return irradiance;
}

/// @param margin  how far footprints reach
template <class Policies>
[[nodiscard]] Estimate splat_from_store(const Bench& bench, const Photons& photons,
                                        const std::vector<PassOfPhotons>& passes, const Policies& policies,
                                        double margin) {
    const FloorMap& floor = bench.map(margin);
    Stopwatch stopwatch;
    auto sums = nephroid::sums<float>(floor.map);
    for (const PassOfPhotons& pass : passes)
        nephroid::splat(std::span(photons.deposits).subspan(pass.deposit, pass.deposit_end - pass.deposit), sums,
                        {.smoothing = pass.smoothing.value()}, policies, bench.threads());
    Estimate result{picture(bench, floor, sums), {}};
    result.seconds = {0, floor.seconds, stopwatch.lap()};
    return result;
}

/// @param light  the case's, or the same without tangents
template <class L, class Policies>
[[nodiscard]] Estimate splat_from_lamp(const Bench& bench, const Photons& photons, const L& light,
                                       const std::vector<PassOfPhotons>& passes, const Policies& policies,
                                       double margin) {
    const FloorMap floor(bench.vertices_with_ghosts(margin));
    Stopwatch stopwatch;
    auto sums = nephroid::sums<float>(floor.map);
    TimingExecutor timing(bench.threads());
    std::visit(
        [&](const auto& sequence) {
            for (const PassOfPhotons& pass : passes)
                static_cast<void>(nephroid::caustics(bench.scene().scene, light, sums,
                                                     PhotonPass{.first = pass.first,
                                                                .count = pass.end - pass.first,
                                                                .total = photons.emitted,
                                                                .smoothing = pass.smoothing,
                                                                .limits = bench.limits()},
                                                     policies, sequence, timing));
        },
        photons.samples);
    Estimate result{picture(bench, floor, sums), {}};
    // Making splats and finding their leaves is a part of the tracing here: the library does both for a photon at a
    // time. Fitting footprints to neighbouring photons is a part of the estimate.
    result.seconds = {timing.trace_seconds(), floor.seconds, stopwatch.lap() - timing.trace_seconds()};
    return result;
}

[[nodiscard]] Estimate splat_differentials(const Bench& bench, const Photons& photons,
                                           const std::vector<PassOfPhotons>& passes, Source source) {
    const double margin = ghost_margin(bench.film(), passes.front().smoothing.value(), double(photons.emitted));
    if (source == Source::lamp)
        return splat_from_lamp(bench, photons, bench.scene().light, passes, Published{}, margin);
    Estimate result = splat_from_store(bench, photons, passes, Published{}, margin);
    result.seconds.trace = photons.trace_seconds;
    return result;
}

/// @param largest  smoothing of a footprint
[[nodiscard]] Estimate splat_to_second_order(const Bench& bench, const Photons& photons,
                                             std::optional<double> smoothing, double largest) {
    Default policies;
    policies.order.domain_repeats = bench.scene().periodic;
    // Photons are shifted by a part of their footprint. Beyond a whole period there is nothing new.
    const double reach = (1 + policies.order.largest_shift) * largest;
    const double margin = (std::min)(1.0, ghost_margin(bench.film(), reach, double(photons.emitted)));
    return splat_from_lamp(bench, photons, bench.scene().light, {whole(photons, smoothing)}, policies, margin);
}

} // namespace

Estimate splat_second_order(const Bench& bench, const Photons& photons, double smoothing, Source) {
    return splat_to_second_order(bench, photons, smoothing, smoothing);
}

Estimate splat_without_parameter(const Bench& bench, const Photons& photons, double, Source) {
    const SmoothingBounds bounds = bounds_for(SmoothingBounds{}, double(photons.emitted));
    return splat_to_second_order(bench, photons, std::nullopt, bounds.largest_radius);
}

Estimate splat(const Bench& bench, const Photons& photons, double smoothing, Source source) {
    return splat_differentials(bench, photons, {whole(photons, smoothing)}, source);
}

Estimate splat_progressively(const Bench& bench, const Photons& photons, double smoothing, Source source) {
    return splat_differentials(bench, photons, shrinking_passes(photons, smoothing), source);
}

Estimate splat_disks(const Bench& bench, const Photons& photons, double radius, Source source) {
    const auto disks = Published{}.with_shape(FixedFootprint{radius});
    const double margin = radius + 2 * bench.film().pixel();
    if (source == Source::lamp)
        return splat_from_lamp(bench, photons, WithoutTangents(bench.scene().light), {whole(photons, 1)}, disks,
                               margin);
    Estimate result = splat_from_store(bench, photons, {whole(photons, 1)}, disks, margin);
    result.seconds.trace = photons.bare_trace_seconds;
    return result;
}

} // namespace nephroid::examples::study
