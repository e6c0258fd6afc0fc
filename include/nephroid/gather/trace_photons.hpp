// SPDX-License-Identifier: MIT
/// @file  Traces photons and keeps them, for photon maps.
#pragma once

#include "nephroid/emission/without_tangents.hpp"
#include "nephroid/execution/checked_executor.hpp"
#include "nephroid/pass/photon_pass.hpp"
#include "nephroid/pass/traced_batch.hpp"
#include "nephroid/sequence/halton.hpp"
#include "nephroid/sequence/sequence.hpp"
#include "nephroid/transport/walk.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

namespace nephroid {

/// The photons that reached a diffuse surface through a specular one.
template <Vector3 V, Flux F, std::size_t N>
struct PhotonTrace {
    std::vector<Deposit<V, F, N>> deposits; ///< in the order of the photons' indices, whoever traced them
    Statistics statistics;                  ///< Fate::splatted are those stored in `deposits`
};

/// Emits photons, walks them through the scene and keeps those that reach a diffuse surface through a specular one: bit
/// for bit the photons that `splat_caustics` splats for the same indices and samples.
///
/// @param scene     the renderer's (transport/scene.hpp); used from several threads
/// @param light     as for `splat_caustics`; `WithoutTangents(light)` where no footprints are needed: the deposits have
///                  no `d_position` then
/// @param pass      which photons, how many in all; `smoothing` scales the deposits' tangents, if they have any. Its
///                  `progress` is called between batches
/// @param sequence  where photon i's numbers come from
/// @param executor  who runs the work; the result does not depend on it, bit for bit
/// @return  the photons stored, and the fates of all. A deposit whose position is not finite is invalid and not
///          stored.
/// Throws std::invalid_argument for zero photons or a smoothing that is not positive. Memory: every photon stored.
template <class S, class L, SampleSequence Sequence = HaltonSequence, class E = SerialExecutor>
    requires PhotonSource<L> && Scene<S, typename L::vector, Sampler<Sequence>> && ExecutorArgument<E>
[[nodiscard]] auto trace_photons(const S& scene, const L& light, const PhotonPass& pass,
                                 const Sequence& sequence = Sequence{}, E&& executor = E{}) {
    using Trace = PhotonTrace<typename L::vector, typename L::flux_type, detail::tangent_count_of<L>>;
    detail::check(pass, "nephroid::trace_photons");
    detail::CheckedExecutor checked(executor);
    constexpr std::uint64_t photons_per_batch = 1 << 16;

    using Kept = std::optional<typename decltype(Trace::deposits)::value_type>;
    const auto spread = detail::spread_of<scalar_t<typename L::vector>>(pass);
    const auto trace_one = [&](std::uint64_t i, Statistics& account) {
        Sampler<Sequence> sampler(sequence, pass.first + i);
        Kept deposit = walk(scene, light.emit(sampler, spread), sampler, pass.limits, account);
        if (!deposit)
            return deposit;
        const bool valid = all_finite(deposit->position) && all_finite(deposit->normal);
        account.end(valid ? Fate::splatted : Fate::invalid,
                    double(flux_traits<typename L::flux_type>::power(deposit->flux)));
        return valid ? deposit : std::nullopt;
    };

    Trace trace;
    detail::TracedBatch<Kept> batch;
    for (std::uint64_t done = 0; done < pass.count;) {
        const std::uint64_t end = done + (std::min)(photons_per_batch, pass.count - done);
        trace.statistics += batch.trace(light, sequence, pass.first, done, end, trace_one, checked);
        const auto kept = std::size_t(trace.statistics[Fate::splatted].photons);
        if (kept > trace.deposits.capacity()) // as push_back would do, but in one step
            trace.deposits.reserve((std::max)(kept, 2 * trace.deposits.capacity()));
        for (std::uint64_t i = done; i < end; ++i)
            if (const Kept& deposit = batch[i])
                trace.deposits.push_back(*deposit);
        done = end;
        if (pass.progress && !pass.progress(done))
            break;
    }
    return trace;
}

} // namespace nephroid
