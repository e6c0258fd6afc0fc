// SPDX-License-Identifier: MIT
/// @file  The first photons of a pass, traced and kept until their neighbours have told how large they should be.
#pragma once

#include "nephroid/execution/executor.hpp"
#include "nephroid/pass/coherent_order.hpp"
#include "nephroid/pass/photon_pass.hpp"
#include "nephroid/sequence/sequence.hpp"
#include "nephroid/smoothing/second_order/second_order.hpp"
#include "nephroid/transport/trail.hpp"
#include "nephroid/transport/walk.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nephroid::detail {

template <class L>
using traced_photon_t = TracedPhoton<typename L::vector, typename L::flux_type, tangent_count_of<L>>;

/// The photon with an index (of the whole picture, not of the pass), emitted with smoothing 1.
template <class S, class L, class Sequence>
[[nodiscard]] traced_photon_t<L> trace_photon(const S& scene, const L& light, const PhotonPass& pass,
                                              const Sequence& sequence, std::uint64_t index, Statistics& account) {
    using T = scalar_t<typename L::vector>;
    const Spread<T> spread{T(pass.emitted_in_all()), T(1)};
    Sampler<Sequence> sampler(sequence, index);
    RecordingSource<Sampler<Sequence>> recorder(sampler, coordinates_of<L>);
    const auto emitted = light.emit(recorder, spread);
    assert(recorder.is_complete()); // else the light draws fewer numbers than its `domain` has coordinates
    PathSignature signature;
    const auto deposit = walk(scene, emitted, sampler, pass.limits, account, signature);
    return {recorder.sample(), EmissionFrame(emitted), signature.value(), deposit};
}

/// The first photons of the picture that a pass is a part of: every part of a picture makes the same of them. A pass
/// without a `total` is a picture of its own.
template <class Photon>
struct Pilot {
    std::uint64_t first = 0; ///< index of the first
    std::vector<Photon> photons;
    std::vector<Statistics> accounts; ///< of each photon: booked when it is splatted, so that a pass can be stopped

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
    const std::span<const PlacedPhoton> sorted = order.sort(light, sequence, pilot.first, count, executor);
    for_each_index(executor, count, 512, [&](std::size_t place) {
        const std::size_t i = sorted[place].number;
        pilot.photons[i] = trace_photon(scene, light, pass, sequence, pilot.first + i, pilot.accounts[i]);
    });
    return pilot;
}

/// What the pilot photons say of the footprints of the whole pass.
///
/// @tparam domains       what the lights may emit from
/// @param largest_reach  of a footprint, world units: the map's diagonal
template <EmissionDomains domains, Vector3 V, Flux F, std::size_t N, class Policies, class E>
[[nodiscard]] SecondOrderFootprints<V, domains> footprints_from(const Pilot<TracedPhoton<V, F, N>>& pilot,
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
    return Footprints(std::span<const TracedPhoton<V, F, N>>(pilot.photons), options, executor);
}

} // namespace nephroid::detail
