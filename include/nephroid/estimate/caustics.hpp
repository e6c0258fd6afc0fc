// SPDX-License-Identifier: MIT
/// @file  Photon differential splatting from the lamp to the eye path vertices: the library's front door.
#pragma once

#include "nephroid/emission/light.hpp"
#include "nephroid/emission/sequence/halton.hpp"
#include "nephroid/emission/sequence/sequence.hpp"
#include "nephroid/emission/spread.hpp"
#include "nephroid/estimate/photon_splatter.hpp"

#include <functional>

namespace nephroid {

/// Which photons a pass traces, and how large their footprints are.
struct PhotonPass {
    std::uint64_t first = 0;  ///< index of the first photon
    std::uint64_t count = 0;  ///< photons emitted in this pass, >= 1
    std::uint64_t total = 0;  ///< N_e: the number that the lights' flux is divided by; 0 means `count`. A pass of a
                              ///< part of a picture's photons (a machine's share, say) gives the whole number here.
    double smoothing = 8;     ///< s > 0: at emission the footprints cover the light's domain s² times
    WalkLimits limits{};
    /// Called between batches with the photons done so far in this pass, from the calling thread; false stops the
    /// pass. The picture then holds the photons that `Statistics::emitted` counts, each with its share of `total`.
    std::function<bool(std::uint64_t)> progress{};
};

namespace detail {
/// A batch is traced in parallel, in chunks, and binned together. How many photons it has follows from how many leaves
/// the splats of the batch before met, so that memory does not grow with the footprints either; it grows by no more
/// than a factor at a time.
inline constexpr std::size_t chunks_per_batch = 64;
inline constexpr std::size_t least_photons = 4 * chunks_per_batch, most_photons = 128 * chunks_per_batch;
inline constexpr std::size_t visits_per_batch = std::size_t(1) << 19, growth = 4;

inline void check(const PhotonPass& pass) {
    if (pass.count == 0)
        invalid_argument("nephroid::splat_caustics: zero photons; count must be at least 1");
    if (!(pass.smoothing > 0) || !std::isfinite(pass.smoothing))
        invalid_argument("nephroid::splat_caustics: smoothing is " + text_of(pass.smoothing) +
                         "; it must be positive and finite (5 to 16 suits most scenes)");
}
} // namespace detail

/// Emits photons, walks them through the scene and splats them onto an eye path map.
///
/// @param scene     the renderer's: rays and surfaces (transport/scene.hpp); used from several threads
/// @param light     one light, or a LightSet of several (emission/light/)
/// @param splatter  holds the map and the sums, and adds to them
/// @param pass      which photons, how many in all, how smooth
/// @param sequence  where photon i's numbers come from; photon i is a pure function of it and i
/// @param executor  who runs the work: called twice for each batch, to trace and to splat. The sums do not depend on
///                  it, bit for bit
/// @return  what became of the flux, and counts
/// Throws std::invalid_argument for zero photons or a smoothing that is not positive.
/// Memory: the splatter's sums and one batch, whatever the number of photons.
template <class S, class L, Vector3 V, Flux F, class Policies, class Response, SampleSequence Sequence = HaltonSequence,
          class E = SerialExecutor>
    requires Scene<S, V, Sampler<Sequence>> && Light<L> && std::same_as<typename L::vector, V> &&
             std::same_as<typename L::flux_type, F> && Executor<std::remove_reference_t<E>&>
Statistics splat_caustics(const S& scene, const L& light, PhotonSplatter<V, F, Policies, Response>& splatter,
                          const PhotonPass& pass, const Sequence& sequence = Sequence{}, E&& executor = E{}) {
    using T = scalar_t<V>;
    using Chunk = typename PhotonSplatter<V, F, Policies, Response>::Chunk;
    detail::check(pass);
    const Spread<T> spread{T(pass.total == 0 ? pass.count : pass.total), T(pass.smoothing)};

    std::vector<Chunk> chunks(detail::chunks_per_batch);
    std::vector<Statistics> accounts(detail::chunks_per_batch);
    Statistics account;
    std::uint64_t batch = detail::growth * detail::least_photons;
    for (std::uint64_t done = 0; done < pass.count;) {
        const std::uint64_t batch_end = done + (std::min)(batch, pass.count - done);
        const std::uint64_t per_chunk = (batch_end - done + detail::chunks_per_batch - 1) / detail::chunks_per_batch;
        executor(detail::chunks_per_batch, [&](std::size_t c) {
            chunks[c].clear();
            Statistics chunk_account;
            const std::uint64_t begin = (std::min)(batch_end, done + c * per_chunk);
            const std::uint64_t end = (std::min)(batch_end, begin + per_chunk);
            for (std::uint64_t i = begin; i < end; ++i) {
                Sampler<Sequence> sampler(sequence, pass.first + i);
                const auto photon = light.emit(sampler, spread);
                if (const auto deposit = walk(scene, photon, sampler, pass.limits, chunk_account))
                    chunks[c].add(splatter, *deposit, chunk_account);
            }
            accounts[c] = chunk_account;
        });
        splatter.add(std::span<const Chunk>(chunks), executor);

        std::uint64_t visits = 1;
        for (std::size_t c = 0; c < detail::chunks_per_batch; ++c) {
            account += accounts[c];
            visits += chunks[c].visits();
        }
        const std::uint64_t fitting = (batch_end - done) * detail::visits_per_batch / visits;
        batch = std::clamp<std::uint64_t>((std::min)(fitting, detail::growth * batch), detail::least_photons,
                                          detail::most_photons);
        done = batch_end;
        if (pass.progress && !pass.progress(done))
            break;
    }
    return account;
}

} // namespace nephroid
