// SPDX-License-Identifier: MIT
#include "common/compare/splatting.hpp"

#include "common/stopwatch.hpp"

#include "nephroid/caustics.hpp"
#include "nephroid/gather/progressive.hpp"

#include <algorithm>
#include <cmath>

namespace nephroid::examples {

namespace {

/// As in Frisvad et al. 2014.
using OfFirstOrder =
    SplatPolicies<BiweightKernel, PixelFilter, DiscardCollapsed, BoundMajorRadius, DifferentialFootprint, FirstOrder>;
using OfSecondOrder =
    SplatPolicies<BiweightKernel, PixelFilter, DiscardCollapsed, BoundMajorRadius, DifferentialFootprint, SecondOrder>;

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

/// Splats stored photons in batches, smaller ones where footprints are large.
template <class Splatter>
void splat_stored(Splatter& splatter, const Photons& photons, const PassOfPhotons& pass, ThreadExecutor& threads) {
    using Chunk = typename Splatter::Chunk;
    constexpr std::size_t chunk_count = 64, least = 4 * chunk_count, most = 128 * chunk_count, visits_wanted = 1u << 19;
    std::vector<Chunk> chunks(chunk_count);
    std::size_t batch = least;
    for (std::size_t begin = pass.deposit; begin < pass.deposit_end;) {
        const std::size_t end = (std::min)(pass.deposit_end, begin + batch);
        const std::size_t per_chunk = (end - begin + chunk_count - 1) / chunk_count;
        threads(chunk_count, [&](std::size_t c) {
            chunks[c].clear();
            Statistics unused;
            const std::size_t chunk_end = (std::min)(end, begin + (c + 1) * per_chunk);
            for (std::size_t i = begin + c * per_chunk; i < chunk_end; ++i) {
                auto deposit = photons.deposits[i];
                for (glm::vec3& tangent : deposit.d_position)
                    tangent *= static_cast<float>(pass.smoothing.value());
                chunks[c].add(splatter, deposit, unused);
            }
        });
        splatter.add(std::span<const Chunk>(chunks), threads);
        std::size_t visits = 1;
        for (const Chunk& chunk : chunks)
            visits += chunk.visits();
        batch = std::clamp((end - begin) * visits_wanted / visits, least, most);
        begin = end;
    }
}

template <class Policies>
[[nodiscard]] std::vector<float> picture(const Bench& bench, const FloorMap& floor,
                                         const PhotonSplatter<glm::vec3, float, Policies>& splatter) {
    std::vector<float> irradiance(bench.film().pixels());
    const float share = 1 / static_cast<float>(bench.film().samples);
    splatter.for_each([&](std::size_t vertex, float e) { irradiance[floor.vertices[vertex].pixel] += share * e; });
    return irradiance;
}

/// @param margin  how far footprints reach
template <class Policies>
[[nodiscard]] Estimate splat_from_store(const Bench& bench, const Photons& photons,
                                        const std::vector<PassOfPhotons>& passes, const Policies& policies,
                                        double margin) {
    const FloorMap& floor = bench.map(margin);
    Stopwatch stopwatch;
    PhotonSplatter<glm::vec3, float, Policies> splatter(floor.map, policies);
    for (const PassOfPhotons& pass : passes)
        splat_stored(splatter, photons, pass, bench.threads());
    Estimate result{picture(bench, floor, splatter), {}};
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
    PhotonSplatter<glm::vec3, float, Policies> splatter(floor.map, policies);
    TimingExecutor timing(bench.threads());
    std::visit(
        [&](const auto& sequence) {
            for (const PassOfPhotons& pass : passes)
                static_cast<void>(splat_caustics(bench.scene().scene, light, splatter,
                                                 PhotonPass{.first = pass.first,
                                                            .count = pass.end - pass.first,
                                                            .total = photons.emitted,
                                                            .smoothing = pass.smoothing,
                                                            .limits = bench.limits()},
                                                 sequence, timing));
        },
        photons.samples);
    Estimate result{picture(bench, floor, splatter), {}};
    // Making splats and finding their leaves is a part of the tracing here: the library does both for a photon at a
    // time. Fitting footprints to neighbouring photons is a part of the estimate.
    result.seconds = {timing.trace_seconds(), floor.seconds, stopwatch.lap() - timing.trace_seconds()};
    return result;
}

[[nodiscard]] Estimate splat_differentials(const Bench& bench, const Photons& photons,
                                           const std::vector<PassOfPhotons>& passes, Source source) {
    const double margin = ghost_margin(bench.film(), passes.front().smoothing.value(), double(photons.emitted));
    if (source == Source::lamp)
        return splat_from_lamp(bench, photons, bench.scene().light, passes, OfFirstOrder{}, margin);
    Estimate result = splat_from_store(bench, photons, passes, OfFirstOrder{}, margin);
    result.seconds.trace = photons.trace_seconds;
    return result;
}

/// @param largest  smoothing of a footprint
[[nodiscard]] Estimate splat_to_second_order(const Bench& bench, const Photons& photons,
                                             std::optional<double> smoothing, double largest) {
    OfSecondOrder policies;
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
    SplatPolicies<BiweightKernel, PixelFilter, DiscardCollapsed, BoundMajorRadius, FixedFootprint> disks{};
    disks.shape = {radius};
    const double margin = radius + 2 * bench.film().pixel();
    if (source == Source::lamp)
        return splat_from_lamp(bench, photons, WithoutTangents(bench.scene().light), {whole(photons, 1)}, disks,
                               margin);
    Estimate result = splat_from_store(bench, photons, {whole(photons, 1)}, disks, margin);
    result.seconds.trace = photons.bare_trace_seconds;
    return result;
}

} // namespace nephroid::examples
