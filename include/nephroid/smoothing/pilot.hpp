// SPDX-License-Identifier: MIT
/// @file  The pilot: the first photons of a picture, traced before the others. All footprints are chosen from them.
#pragma once

#include "nephroid/execution/task_runner.hpp"
#include "nephroid/pass/coherent_order.hpp"
#include "nephroid/pass/photon_pass.hpp"
#include "nephroid/sequence/sequence.hpp"
#include "nephroid/smoothing/second_order/path_pieces.hpp"
#include "nephroid/smoothing/second_order/second_order.hpp"
#include "nephroid/splat/spectral_splat.hpp"
#include "nephroid/transport/walk.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace nephroid::detail {

template <class L>
using traced_photon_t = TracedPhoton<typename L::vector, typename L::flux_type, tangent_count_of<L>, parameters_t<L>>;

/// Traces a photon, emitted with smoothing 1.
///
/// @param index  of the photon in the whole picture, not in the pass
/// @param trail  notes its path
template <class S, class L, class Sequence>
[[nodiscard]] traced_photon_t<L> trace_photon(const S& scene, const L& light, const PhotonPass& pass,
                                              const Sequence& sequence, std::uint64_t index, Statistics& account,
                                              PathTrail<typename L::vector>& trail) {
    using T = scalar_t<typename L::vector>;
    const Spread<T> spread{T(pass.emitted_in_all()), T(1)};
    Sampler<Sequence> sampler(sequence, index);
    RecordingSource<Sampler<Sequence>> recorder(sampler, coordinates_of<L>);
    auto emitted = light.emit(recorder, spread);
    assert(recorder.is_complete()); // otherwise the light drew fewer numbers than its `domain` has coordinates
    const EmissionFrame frame(plain(emitted));
    auto deposit = walk(scene, std::move(emitted), sampler, pass.limits, account, trail);
    auto parameters = parameters_of(emitted);
    if constexpr (has_wavelength<parameters_t<L>>)
        if (deposit)
            move_to_middle(*deposit, parameters);
    return {recorder.sample(), frame, trail.value(), deposit, parameters};
}

/// The first photons of the picture that a pass is a part of. All passes of one picture make the same pilot. A pass
/// without a `total` is a picture of its own.
template <class Photon>
struct Pilot {
    std::uint64_t first = 0; ///< index of the first photon
    std::vector<Photon> photons;
    std::vector<Statistics> accounts; ///< of each photon; added up as it is splatted, since a pass may be stopped
    PathPieces<typename Photon::vector> pieces{}; ///< into which its photons' paths are split

    [[nodiscard]] bool has(std::uint64_t index) const { return index >= first && index - first < photons.size(); }
    [[nodiscard]] Photon take(std::uint64_t index, Statistics& account) const {
        account += accounts[std::size_t(index - first)];
        return photons[std::size_t(index - first)];
    }
};

template <class S, class L, class Sequence, class E>
[[nodiscard]] Pilot<traced_photon_t<L>> trace_pilot(const S& scene, const L& light, const PhotonPass& pass,
                                                    const SecondOrder& policy, const Sequence& sequence, E& executor) {
    const auto count = std::size_t((std::min)(pass.emitted_in_all(), policy.pilot));
    Pilot<traced_photon_t<L>> pilot{pass.total == 0 ? pass.first : 0, std::vector<traced_photon_t<L>>(count),
                                    std::vector<Statistics>(count)};
    announce(executor, Phase::trace);
    CoherentOrder order;
    const std::span<const KeyedPhoton> sorted = order.sort(light, sequence, pilot.first, count, executor);
    typename PathPieces<typename L::vector>::FirstPoints firsts(count);
    for_each_index(executor, count, 512, [&](std::size_t position) {
        const std::size_t i = sorted[position].number;
        PathTrail<typename L::vector> trail;
        pilot.photons[i] = trace_photon(scene, light, pass, sequence, pilot.first + i, pilot.accounts[i], trail);
        firsts[i] = trail.first();
    });
    pilot.pieces = PathPieces<typename L::vector>(pilot.photons, firsts, TaskRunner(executor));
    return pilot;
}

/// Fits the footprints of the whole pass to the pilot.
///
/// @tparam domains       the kinds of domains that the lights may have
/// @param largest_reach  of a footprint, world units: the receiver's diagonal
template <EmissionDomains domains, Vector3 V, Flux F, std::size_t N, class P, class Policies, class E>
[[nodiscard]] SecondOrderFootprints<V, domains> fit_footprints(const Pilot<TracedPhoton<V, F, N, P>>& pilot,
                                                               const PhotonPass& pass, const Policies& policies,
                                                               double largest_reach, bool stratified, E& executor) {
    using Kernel = std::remove_cvref_t<decltype(policies.kernel)>;
    using Footprints = SecondOrderFootprints<V, domains>;
    const typename Footprints::Options options{.policy = policies.order,
                                               .smoothing = pass.smoothing,
                                               .stratified = stratified,
                                               .second_moment = double(Kernel::second_moment),
                                               .photons = double(pass.emitted_in_all()),
                                               .largest_reach = largest_reach};
    announce(executor, Phase::fit);
    return Footprints(std::span<const TracedPhoton<V, F, N, P>>(pilot.photons.data(), pilot.photons.size()), options,
                      executor);
}

} // namespace nephroid::detail
