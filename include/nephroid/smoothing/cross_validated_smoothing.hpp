// SPDX-License-Identifier: MIT
/// @file  The one smoothing that suits a pass best, found by comparing pictures from parts of its photons.
#pragma once

#include "nephroid/smoothing/cross_validation.hpp"
#include "nephroid/smoothing/pilot.hpp"
#include "nephroid/smoothing/policies.hpp"
#include "nephroid/splat/splat_arguments.hpp"

namespace nephroid {

/// The smoothing that suits a pass best as a whole, for plain splats: what `PhotonPass::smoothing` takes.
///
/// Second-order splatting chooses a footprint for each photon and asks for none of this, but for photons of lights
/// whose samples say nothing of which ones are neighbours: for those `caustics` does it by itself.
///
/// ```cpp
/// pass.smoothing = nephroid::cross_validated_smoothing(scene, light, sums, pass);
/// nephroid::splat_caustics(scene, light, sums, pass);
/// ```
///
/// @param sums       tell the map and the response; are left as they are
/// @param pass       of which up to 65536 photons are traced, the first; its own smoothing does not matter
/// @param arguments  in any order, none needed: splat policies (`Default` unless told), a sequence, an executor
/// @return  2.5 to 40 for as many photons as were compared, more for a longer pass; 8 where fewer than 64 of them land.
///          The same for any number of threads, bit for bit
/// Throws std::invalid_argument for zero photons.
///
/// A vertex is taken to show what is estimated there. Where a renderer adds several up to one pixel, each with a part
/// of the light (ghosts around a floor that repeats), the borders between the parts are taken for edges, and s is too
/// small.
///
/// Cost: tracing those photons, and splatting them onto some 32,000 of the vertices with smoothings of 2.5 up to twice
/// the one chosen: measured as one to four passes of 20,000 photons onto 512 x 512 vertices, and less than one of
/// 160,000. Memory: the photons traced, and the sums once more.
template <class S, class L, class V, class F, class R, detail::MustBeSplatArgument... Arguments>
    requires(detail::MustNotRepeat<Arguments...>&& detail::MustEmit<L, V, F>&&
                 detail::MustBeScene<S, V, Sampler<detail::sequence_among<Arguments...>>>)
[[nodiscard]] double cross_validated_smoothing(const S& scene, const L& light, const Sums<V, F, R>& sums,
                                               const PhotonPass& pass, Arguments&&... arguments) {
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
