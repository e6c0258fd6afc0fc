// SPDX-License-Identifier: MIT
/// @file  The published method: photon differential splatting from the lamp to the eye path vertices
///        [Frisvad et al. 2014]. Include this instead of nephroid/caustics.hpp to compile no second order.
#pragma once

#include "nephroid/emission/without_tangents.hpp"
#include "nephroid/execution/thread_executor.hpp"
#include "nephroid/pass/photon_pass.hpp"
#include "nephroid/pass/traced_batch.hpp"
#include "nephroid/splat/landed_photon.hpp"
#include "nephroid/splat/splat_arguments.hpp"
#include "nephroid/splat/splat_in_batches.hpp"

#include <cstdint>

namespace nephroid {

namespace detail {
/// Splats each photon where it lands, with the same smoothing for all.
template <class S, class L, class V, class F, class R, class Policies, class Sequence, class E>
Statistics splat_to_first_order(const S& scene, const L& light, Sums<V, F, R>& sums, const PhotonPass& pass,
                                const Policies& policies, const Sequence& sequence, E& executor) {
    const auto spread = spread_of<scalar_t<V>>(pass);
    Splatter splatter(sums, policies);
    TracedBatch<LandedPhoton<L>> batch;
    const auto trace_one = [&](std::uint64_t i, Statistics& account) {
        Sampler<Sequence> sampler(sequence, pass.first + i);
        return land(scene, light, sampler, spread, pass.limits, account);
    };
    return splat_in_batches(
        splatter, pass.count,
        [&](std::uint64_t i, auto& chunk, Statistics& account) {
            if (const LandedPhoton<L>& photon = batch[i]; photon.deposit)
                prepare_splats(splatter, *photon.deposit, photon.parameters, chunk, account);
        },
        executor,
        [&](std::uint64_t begin, std::uint64_t end) {
            return batch.trace(light, sequence, pass.first, begin, end, trace_one, executor);
        },
        pass.progress);
}
} // namespace detail

/// Emits photons, follows them through the scene, and splats each onto the eye path vertices where it lands.
///
/// ```cpp
/// const nephroid::EyePathMap map(vertices, &MyVertex::position, &MyVertex::normal);
/// auto sums = nephroid::sums<float>(map);
/// nephroid::splat_caustics(scene, light, sums, {.count = 100'000}, threads);
/// ```
///
/// @param scene      the renderer's: rays and surfaces (transport/scene.hpp); used from several threads
/// @param light      one light, or a LightSet of several (emission/light/); WithoutTangents for policies that use no
///                   differentials (FixedFootprint)
/// @param sums       the light is added to these (receiver/sums.hpp)
/// @param pass       which photons to trace, how many there are in all, and their smoothing
/// @param arguments  optional, in any order: first-order splat policies (otherwise `Published`), the sequence that
///                   photon i's numbers come from (otherwise `HaltonSequence`), and an executor that runs the work of
///                   each batch (otherwise `SerialExecutor`). The sums are the same bit for bit with any executor
/// @return  what became of the flux, with counts
/// Throws std::invalid_argument for zero photons and a smoothing that is not positive. Memory: the sums and one batch,
/// whatever the number of photons.
template <class S, class L, class V, class F, class R, detail::MustBeSplatArgument... Arguments>
    requires(detail::MustNotRepeat<Arguments...>&& detail::MustEmit<L, V, F>&&
                 detail::MustBeScene<detail::scene_for<S, L>, V, Sampler<detail::sequence_among<Arguments...>>>)
Statistics splat_caustics(const S& scene, const L& light, Sums<V, F, R>& sums, const PhotonPass& pass,
                          Arguments&&... arguments) {
    using Policies = detail::policies_among<Published, Arguments...>;
    static_assert(!decltype(Policies::order)::uses_neighbours,
                  "nephroid: splat_caustics splats to first order; call nephroid::caustics (nephroid/caustics.hpp) for "
                  "SecondOrder");
    detail::check(pass, "nephroid::splat_caustics");
    return detail::with_splat_arguments<Published>(
        [&](const auto& policies, const auto& sequence, auto& executor) {
            return detail::splat_to_first_order(scene, light, sums, pass, policies, sequence, executor);
        },
        arguments...);
}

} // namespace nephroid
