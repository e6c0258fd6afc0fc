// SPDX-License-Identifier: MIT
/// @file  Photon differential splatting from the lamp to the eye path vertices: the library's front door.
#pragma once

#include "nephroid/emission/without_tangents.hpp"
#include "nephroid/execution/thread_executor.hpp"
#include "nephroid/pass/photon_pass.hpp"
#include "nephroid/pass/traced_batch.hpp"
#include "nephroid/sequence/halton.hpp"
#include "nephroid/sequence/sequence.hpp"
#include "nephroid/smoothing/cross_validation.hpp"
#include "nephroid/smoothing/pilot.hpp"
#include "nephroid/smoothing/second_order/curved_footprints.hpp"
#include "nephroid/splat/photon_splatter.hpp"
#include "nephroid/transport/walk.hpp"

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace nephroid {

namespace detail {
/// A batch is traced in parallel, made ready in chunks, and binned together. How many photons it has follows from how
/// many leaves the splats of the batch before met, so that memory does not grow with the footprints either; it grows by
/// no more than a factor at a time. The more it has, the closer together are those that are traced one after the other.
inline constexpr std::size_t chunks_per_batch = 64;
inline constexpr std::size_t least_photons = 4 * chunks_per_batch, first_photons = 16 * chunks_per_batch,
                             most_photons = 1024 * chunks_per_batch;
inline constexpr std::size_t most_watched = most_photons / 8; // where somebody waits to stop the pass
inline constexpr std::size_t visits_per_batch = std::size_t(1) << 19, growth = 8;

/// For photons that were traced before.
struct NothingToTrace {
    Statistics operator()(std::uint64_t, std::uint64_t) const { return {}; }
};

/// Splats photons 0 to count − 1 of a pass.
///
/// @param add_photon  add_photon(i, chunk, account) adds photon i with its final footprint to the chunk; what became of
///                    it otherwise is in the account. Called from several threads
/// @param trace       trace(begin, end) -> Statistics: called before photons begin to end − 1 are added
template <class Splatter, class AddPhoton, class E, class Trace = NothingToTrace>
Statistics splat_in_batches(Splatter& splatter, const PhotonPass& pass, const AddPhoton& add_photon, E& executor,
                            const Trace& trace = {}) {
    using Chunk = typename Splatter::Chunk;
    std::vector<Chunk> chunks(chunks_per_batch);
    std::vector<Statistics> accounts(chunks_per_batch);
    Statistics account;
    std::uint64_t batch = first_photons;
    for (std::uint64_t done = 0; done < pass.count;) {
        const std::uint64_t batch_end = done + (std::min)(batch, pass.count - done);
        const std::uint64_t per_chunk = (batch_end - done + chunks_per_batch - 1) / chunks_per_batch;
        announce(executor, Phase::trace);
        account += trace(done, batch_end);
        executor(chunks_per_batch, [&](std::size_t c) {
            chunks[c].clear();
            Statistics chunk_account;
            const std::uint64_t begin = (std::min)(batch_end, done + c * per_chunk);
            const std::uint64_t end = (std::min)(batch_end, begin + per_chunk);
            for (std::uint64_t i = begin; i < end; ++i)
                add_photon(i, chunks[c], chunk_account);
            accounts[c] = chunk_account;
        });
        announce(executor, Phase::splat);
        splatter.add(std::span<const Chunk>(chunks), executor);

        std::uint64_t visits = 1;
        for (std::size_t c = 0; c < chunks_per_batch; ++c) {
            account += accounts[c];
            visits += chunks[c].visits();
        }
        const std::uint64_t fitting = (batch_end - done) * visits_per_batch / visits;
        batch = std::clamp<std::uint64_t>((std::min)(fitting, growth * batch), least_photons,
                                          pass.progress ? most_watched : most_photons);
        done = batch_end;
        if (pass.progress && !pass.progress(done))
            break;
    }
    return account;
}

/// Adds a photon where its neighbours say, in the footprint or the pieces that they say.
template <class Footprints, class Photon, class Splatter>
void add_placed(const Footprints& footprints, Photon& photon, const Splatter& splatter, typename Splatter::Chunk& chunk,
                Statistics& account) {
    const auto& policies = splatter.policies();
    if constexpr (std::derived_from<std::remove_cvref_t<decltype(policies.order)>, CurvedFootprints>) {
        std::array<Space3, 3> second;
        account.bounded_shifts += footprints.apply(photon, &second);
        const double moment = std::remove_cvref_t<decltype(policies.kernel)>::second_moment;
        chunk.add(splatter, curved(*photon.deposit, second, policies.order, moment).pieces(), account);
    } else {
        account.bounded_shifts += footprints.apply(photon);
        chunk.add(splatter, *photon.deposit, account);
    }
}

/// Whether footprints are to be placed and sized by neighbouring photons: they need differentials for it.
template <class Policies, class L>
inline constexpr bool is_second_order = Light<L>&& requires(const Policies policies) {
    requires std::derived_from<std::remove_cvref_t<decltype(policies.order)>, SecondOrder>;
    requires std::same_as<std::remove_cvref_t<decltype(policies.shape)>, DifferentialFootprint>;
};
} // namespace detail

/// Emits photons, walks them through the scene and splats them onto an eye path map.
///
/// @param scene     the renderer's: rays and surfaces (transport/scene.hpp); used from several threads
/// @param light     one light, or a LightSet of several (emission/light/); WithoutTangents for a splatter whose
///                  policies use no differentials (FixedFootprint)
/// @param splatter  holds the map and the sums, and adds to them
/// @param pass      which photons, how many in all, how smooth
/// @param sequence  where photon i's numbers come from; photon i is a pure function of it and i
/// @param executor  who runs the work: called to trace and to splat each batch. The sums do not depend on it, bit for
///                  bit
/// @return  what became of the flux, and counts
/// Throws std::invalid_argument for zero photons, a smoothing that is not positive, and bounds of `SecondOrder` that
/// cannot be.
/// Memory: the splatter's sums, one batch, and the pilot photons of second-order splatting, whatever the number of
/// photons; while a smoothing is chosen for lights without cells (cross_validation.hpp), the sums twice.
template <class S, class L, Vector3 V, Flux F, class Policies, class Response,
          detail::MustBeSequence Sequence = HaltonSequence, ExecutorArgument E = SerialExecutor>
    requires(detail::MustBeScene<S, V, Sampler<Sequence>>&& detail::MustEmit<L, V, F>)
Statistics splat_caustics(const S& scene, const L& light, PhotonSplatter<V, F, Policies, Response>& splatter,
                          const PhotonPass& pass, const Sequence& sequence = Sequence{}, E&& executor = E{}) {
    using T = scalar_t<V>;
    detail::check(pass, "nephroid::splat_caustics");
    if constexpr (detail::is_second_order<Policies, L>) {
        detail::check(splatter.policies().order, "nephroid::splat_caustics");
        const auto pilot = detail::trace_pilot(scene, light, pass, splatter.policies().order, sequence, executor);
        auto footprints = detail::footprints_from<emission_domains<L>>(
            pilot, pass, splatter.policies(), double(splatter.map().diagonal()), Sequence::stratified, executor);
        if constexpr (emission_domains<L>.others)
            if (!pass.smoothing)
                footprints.smooth_others(detail::smoothing_without_cells<decltype(footprints)>(
                    splatter, pilot, pass, Sequence::stratified, executor));
        detail::TracedBatch<detail::traced_photon_t<L>> batch;
        return detail::splat_in_batches(
            splatter, pass,
            [&](std::uint64_t i, auto& chunk, Statistics& account) {
                if (batch[i].deposit)
                    detail::add_placed(footprints, batch[i], splatter, chunk, account);
            },
            executor,
            [&](std::uint64_t begin, std::uint64_t end) {
                return batch.trace(
                    light, sequence, pass.first, begin, end,
                    [&](std::uint64_t i, Statistics& account) {
                        return pilot.has(pass.first + i)
                                   ? pilot.take(pass.first + i, account)
                                   : detail::trace_photon(scene, light, pass, sequence, pass.first + i, account);
                    },
                    executor);
            });
    } else {
        const Spread<T> spread = detail::spread_of<T>(pass);
        detail::TracedBatch<std::optional<Deposit<V, F, detail::tangent_count_of<L>>>> batch;
        return detail::splat_in_batches(
            splatter, pass,
            [&](std::uint64_t i, auto& chunk, Statistics& account) {
                if (const auto& deposit = batch[i])
                    chunk.add(splatter, *deposit, account);
            },
            executor,
            [&](std::uint64_t begin, std::uint64_t end) {
                return batch.trace(
                    light, sequence, pass.first, begin, end,
                    [&](std::uint64_t i, Statistics& account) {
                        Sampler<Sequence> sampler(sequence, pass.first + i);
                        return walk(scene, light.emit(sampler, spread), sampler, pass.limits, account);
                    },
                    executor);
            });
    }
}

} // namespace nephroid
