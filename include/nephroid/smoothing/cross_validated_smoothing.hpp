// SPDX-License-Identifier: MIT
/// @file  Chooses the best single smoothing for a pass by comparing pictures from parts of its photons.
#pragma once

#include "nephroid/emission/parameters.hpp"
#include "nephroid/smoothing/cross_validation.hpp"
#include "nephroid/smoothing/pilot.hpp"
#include "nephroid/smoothing/second_order/policies.hpp"
#include "nephroid/splat/landed_photon.hpp"
#include "nephroid/splat/splat_arguments.hpp"

#include <type_traits>

namespace nephroid {

/// The best single smoothing for a pass of plain splats, to be given as `PhotonPass::smoothing`.
///
/// Second-order splatting does not need it: it chooses a footprint for each photon. For photons without neighbours
/// (their light declares no domain) `caustics` calls this function by itself.
///
/// ```cpp
/// pass.smoothing = nephroid::cross_validated_smoothing(scene, light, sums, pass);
/// nephroid::splat_caustics(scene, light, sums, pass);
/// ```
///
/// @param sums       provides the receiver and the response; it is not changed
/// @param pass       its first photons, 65536 at most, are traced; its own smoothing does not matter
/// @param arguments  optional, in any order: splat policies (otherwise `Default`), a sequence, an executor
/// @return  2.5 to 40 if the pass has no more photons than were traced, more for a longer pass; 8 if fewer than 64
///          land. The same bit for bit for any number of threads
/// Throws std::invalid_argument for zero photons.
///
/// Every vertex counts as a pixel. If a renderer adds several vertices to one pixel, each with a part of the light
/// (copies around a floor that repeats), the borders between these parts look like edges, and the result is too small.
///
/// Cost: tracing these photons, and splatting them onto about 32,000 of the vertices, with smoothings from 2.5 to twice
/// the result. Measured: one to four passes of 20,000 photons onto 512 x 512 vertices, and less than one pass of
/// 160,000. Memory: the traced photons and a copy of the sums.
template <class S, class L, class V, class F, class R, detail::MustBeSplatArgument... Arguments>
    requires(detail::MustNotRepeat<Arguments...>&& detail::MustEmit<L, V, F>&&
                 detail::MustBeScene<detail::scene_for<S, L>, V, Sampler<detail::sequence_among<Arguments...>>>)
[[nodiscard]] double cross_validated_smoothing(const S& scene, const L& light, const Sums<V, F, R>& sums,
                                               const PhotonPass& pass, Arguments&&... arguments) {
    static_assert(std::is_same_v<detail::parameters_t<L>, NoParameters>,
                  "nephroid: cross_validated_smoothing scales all tangents, and those of Spectral and Extended lights "
                  "by wavelength and extent have a size of their own; give a smoothing, or leave it to caustics");
    static_assert(Light<L>, "nephroid: cross_validated_smoothing needs a light with tangents, not WithoutTangents");
    detail::check(pass, "nephroid::cross_validated_smoothing");
    return detail::with_splat_arguments<Default>(
        [&](const auto& policies, const auto& sequence, auto& executor) {
            const auto pilot = detail::trace_pilot(scene, light, pass, SecondOrder{}, sequence, executor);
            const auto deposit_of = [&pilot](std::size_t i) -> const auto& { return pilot.photons[i].deposit; };
            return detail::cross_validated(sums, policies, pilot.photons.size(), double(pass.emitted_in_all()),
                                           sequence.stratified, deposit_of, executor);
        },
        arguments...);
}

} // namespace nephroid
