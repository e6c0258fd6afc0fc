// SPDX-License-Identifier: MIT
/// @file  Photons traced and kept: what photon maps are made of.
#pragma once

#include "nephroid/emission/sequence/halton.hpp"
#include "nephroid/emission/sequence/sequence.hpp"
#include "nephroid/emission/without_tangents.hpp"
#include "nephroid/estimate/photon_pass.hpp"
#include "nephroid/transport/executor.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>
#include <vector>

namespace nephroid {

/// The photons that reached a diffuse surface through a specular one.
template <Vector3 V, Flux F, std::size_t N>
struct PhotonTrace {
    std::vector<Deposit<V, F, N>> deposits; ///< in the order of the photons' indices, whoever traced them
    Statistics statistics;                  ///< Fate::splatted are those stored in `deposits`
};

namespace detail {
inline constexpr std::uint64_t photons_per_chunk = 1024;

template <class L>
inline constexpr std::size_t tangent_count_of = std::remove_cvref_t<decltype(std::declval<const L&>().emit(
    std::declval<AnySampleSource&>(), std::declval<const Spread<scalar_t<typename L::vector>>&>()))>::tangent_count;

/// Traces photons [begin, end) of a pass, in order.
template <class S, class L, class Sequence, Vector3 V, Flux F, std::size_t N>
void trace_chunk(const S& scene, const L& light, const PhotonPass& pass, const Sequence& sequence, std::uint64_t begin,
                 std::uint64_t end, PhotonTrace<V, F, N>& trace) {
    const auto spread = spread_of<scalar_t<V>>(pass);
    for (std::uint64_t i = begin; i < end; ++i) {
        Sampler<Sequence> sampler(sequence, pass.first + i);
        const auto photon = light.emit(sampler, spread);
        const auto deposit = walk(scene, photon, sampler, pass.limits, trace.statistics);
        if (!deposit)
            continue;
        const bool valid = all_finite(deposit->position) && all_finite(deposit->normal);
        trace.statistics.end(valid ? Fate::splatted : Fate::invalid, double(flux_traits<F>::power(deposit->flux)));
        if (valid)
            trace.deposits.push_back(*deposit);
    }
}
} // namespace detail

/// Emits photons, walks them through the scene and keeps those that `splat_caustics` would splat: the same photons, bit
/// for bit, from the same indices and samples.
///
/// @param scene     the renderer's (transport/scene.hpp); used from several threads
/// @param light     as for `splat_caustics`; `WithoutTangents(light)` where no footprints are needed: the deposits have
///                  no `d_position` then
/// @param pass      which photons, how many in all; `smoothing` scales the deposits' tangents, if they have any. Its
///                  `progress` is called between batches
/// @param sequence  where photon i's numbers come from
/// @param executor  who runs the work; the result does not depend on it, bit for bit
/// @return  the photons stored, and what became of the others. A deposit whose position is not finite is invalid and
///          not stored.
/// Throws std::invalid_argument for zero photons or a smoothing that is not positive. Memory: every photon stored.
template <class S, class L, SampleSequence Sequence = HaltonSequence, class E = SerialExecutor>
    requires PhotonSource<L> && Scene<S, typename L::vector, Sampler<Sequence>> && ExecutorArgument<E>
[[nodiscard]] auto trace_photons(const S& scene, const L& light, const PhotonPass& pass,
                                 const Sequence& sequence = Sequence{}, E&& executor = E{}) {
    using Trace = PhotonTrace<typename L::vector, typename L::flux_type, detail::tangent_count_of<L>>;
    detail::check(pass, "nephroid::trace_photons");
    constexpr std::uint64_t chunk = detail::photons_per_chunk, most_chunks = 64;

    Trace trace;
    std::vector<Trace> parts;
    for (std::uint64_t done = 0; done < pass.count;) {
        const std::uint64_t end = done + (std::min)(most_chunks * chunk, pass.count - done);
        parts.assign(std::size_t((end - done + chunk - 1) / chunk), Trace{});
        executor(parts.size(), [&](std::size_t part) {
            const std::uint64_t begin = done + part * chunk;
            detail::trace_chunk(scene, light, pass, sequence, begin, (std::min)(end, begin + chunk), parts[part]);
        });
        for (const Trace& part : parts) {
            trace.deposits.insert(trace.deposits.end(), part.deposits.begin(), part.deposits.end());
            trace.statistics += part.statistics;
        }
        done = end;
        if (pass.progress && !pass.progress(done))
            break;
    }
    return trace;
}

} // namespace nephroid
