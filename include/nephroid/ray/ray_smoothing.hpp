// SPDX-License-Identifier: MIT
/// @file  The smoothing of a pass of photon rays: the caller's, or the best one by cross-validation on a pilot.
#pragma once

#include "nephroid/ray/check_rays.hpp"
#include "nephroid/ray/ray_splatter.hpp"
#include "nephroid/ray/traced_flights.hpp"
#include "nephroid/smoothing/cross_validation.hpp"
#include "nephroid/smoothing/leaf_sample.hpp"
#include "nephroid/splat/splat_in_batches.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

namespace nephroid::detail {

/// The median spacing of a receiver's leaves, world units; 0 without leaves.
template <Vector3 V>
[[nodiscard]] scalar_t<V> median_spacing(const EyePathMap<V>& map) {
    std::vector<scalar_t<V>> spacings;
    for (std::uint32_t leaf = 0; leaf < map.tree().leaves().size(); ++leaf)
        spacings.push_back(map.leaf(leaf).spacing);
    if (spacings.empty())
        return scalar_t<V>(0);
    const auto middle = spacings.begin() + std::ptrdiff_t(spacings.size() / 2);
    std::nth_element(spacings.begin(), middle, spacings.end());
    return *middle;
}

/// How the beams of a pass start, at a smoothing.
template <Vector3 V, class Width>
[[nodiscard]] BeamStart<scalar_t<V>> beam_start(const EyePathMap<V>& map, const Width& width, const PhotonPass& pass,
                                                double smoothing) {
    using T = scalar_t<V>;
    BeamStart<T> start{{T(pass.emitted_in_all()), T(smoothing)}, T(0), T(0.1) / pi<T>};
    if constexpr (requires { width.start_spacings; })
        start.radius = width.start > 0 ? T(width.start) : T(width.start_spacings) * median_spacing(map);
    if constexpr (requires { Width::least_cosine; })
        start.least_density = T(Width::least_cosine) / pi<T>;
    return start;
}

/// A smoothing, and whether cross-validation found it.
struct RaySmoothing {
    double smoothing;
    bool is_chosen;
};

/// Pictures of the quarters of a pilot at some of the vertices.
///
/// @param s  smoothing of the four quarters together; a single quarter is splatted as it would be among them
template <class S, class L, class V, class F, class R, class Policies, class Sequence, class E>
[[nodiscard]] QuarterPictures ray_quarters(const S& scene, const L& lamp, const Sums<V, F, R>& like,
                                           const PhotonPass& pilot, double s, const Policies& policies,
                                           const Sequence& sequence, E& executor) {
    constexpr std::size_t vertices = 4096;
    Sums<V, F, response_within<R>> sums(like.map(), like.response()); // of flux: they are only compared
    const LeafSample sample(sums.map().tree(), vertices);
    RaySplatter splatter(scene, sums, policies);
    QuarterPictures pictures;
    for (std::size_t quarter = 0; quarter < pictures.size(); ++quarter) {
        sums.clear();
        PhotonPass part = pilot;
        part.count = pilot.count / 4, part.total = pilot.count;
        part.first = pilot.first + quarter * part.count;
        TracedFlights photons(scene, lamp, part, policies.flights, beam_start(sums.map(), policies.width, part, s),
                              sequence);
        splat_in_batches(
            splatter, part.count,
            [&](std::uint64_t i, auto& chunk, Statistics& unused) {
                for (const auto& flight : photons[i])
                    splatter.prepare(flight, chunk, unused, sample);
            },
            executor, [&](std::uint64_t begin, std::uint64_t end) { return photons.trace(begin, end, executor); });
        sample.for_each([&](std::uint32_t leaf) {
            for (const F& sum : std::as_const(sums).of_leaf(leaf))
                pictures[quarter].push_back(4 * double(flux_traits<F>::power(sum)));
        });
    }
    return pictures;
}

/// The smoothing of a pass. Behind a diffuse bounce even photons of a stratified sequence are random, so that the
/// halves are independent. A beam's variance falls with s², and the square of its bias grows with s⁴: s ∝ N^(1/6)
/// of random photons in two dimensions.
template <class S, class L, class V, class F, class R, class Policies, class Sequence, class E>
[[nodiscard]] RaySmoothing smoothing_of_rays(const S& scene, const L& lamp, const Sums<V, F, R>& sums,
                                             const PhotonPass& pass, const Policies& policies, const Sequence& sequence,
                                             E& executor) {
    using Width = std::remove_cvref_t<decltype(policies.width)>;
    constexpr std::uint64_t most = 16384, fewest = 256;
    constexpr double sharpest = 4;
    constexpr std::size_t most_steps = 10; // s is 90 at most for the pilot
    if (pass.smoothing || !uses_smoothing<Width>)
        return {pass.smoothing.value_or(default_smoothing), false};
    PhotonPass pilot = pass;
    if (pass.total != 0) // parts of one picture have one pilot
        pilot.first = 0;
    pilot.count = (std::min)(most, pass.emitted_in_all());
    pilot.progress = {};
    if (pilot.count < fewest || sums.map().tree().empty())
        return {default_smoothing, false};
    announce(executor, Phase::fit);
    const auto pictures_at = [&](std::size_t step) {
        return ray_quarters(scene, lamp, sums, pilot, sharpest * std::exp2(0.5 * double(step)), policies, sequence,
                            executor);
    };
    const QuarterPictures first = pictures_at(0);
    const std::optional<double> best = best_step(
        [&](std::size_t step) { return validated_error(step == 0 ? first : pictures_at(step), first, 1); }, most_steps);
    if (!best)
        return {default_smoothing, false};
    const double growth = std::pow(double(pass.emitted_in_all()) / double(pilot.count), 1.0 / 6);
    return {sharpest * std::exp2(0.5 * *best) * growth, true};
}

} // namespace nephroid::detail
