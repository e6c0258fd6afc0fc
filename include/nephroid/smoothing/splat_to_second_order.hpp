// SPDX-License-Identifier: MIT
/// @file  Splatting to second order: footprints and shifts of all photons are chosen from a pilot.
#pragma once

#include "nephroid/pass/traced_batch.hpp"
#include "nephroid/smoothing/compared_with_published.hpp"
#include "nephroid/smoothing/cross_validation.hpp"
#include "nephroid/smoothing/pilot.hpp"
#include "nephroid/smoothing/second_order/curved_footprints.hpp"
#include "nephroid/smoothing/second_order/policies.hpp"
#include "nephroid/splat/landed_photon.hpp"
#include "nephroid/splat/splat_in_batches.hpp"

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace nephroid::detail {

/// Whether neighbouring photons are to shift and size the footprints, which needs tangents.
template <class Policies, class L>
inline constexpr bool is_second_order = Light<L>&& decltype(Policies::order)::uses_neighbours&&
    std::same_as<decltype(Policies::shape), DifferentialFootprint>;

inline void count(const AppliedFootprint& applied, Statistics& account) {
    account.bounded_shifts += applied.shortened;
    account.splatted_as_published += applied.as_published;
}

/// Shifts a photon and gives it its footprint. Tangents that are not the footprint's stay as they are.
template <class Footprints, Vector3 V, Flux F, std::size_t N, class P>
AppliedFootprint apply(const Footprints& footprints, TracedPhoton<V, F, N, P>& photon,
                       std::array<Double3, 3>* second = nullptr) {
    const std::array<V, N> before = photon.deposit->d_position;
    const AppliedFootprint applied = footprints.apply(photon, second);
    for (std::size_t i = 2; i < N; ++i)
        if (tangent_kinds<N, P>[i] != TangentKind::footprint)
            photon.deposit->d_position[i] = before[i];
    return applied;
}

/// Shifts a photon, gives it the footprint or the pieces chosen, and prepares its splats.
template <class Footprints, class Photon, class Splatter>
void prepare_shifted(const Footprints& footprints, Photon& photon, const Splatter& splatter,
                     typename Splatter::Chunk& chunk, Statistics& account) {
    const auto& policies = splatter.policies();
    if constexpr (std::derived_from<std::remove_cvref_t<decltype(policies.order)>, CurvedFootprints>) {
        static_assert(!has_wavelength<decltype(Photon::parameters)>,
                      "nephroid: CurvedFootprints splat photons in pieces, and so do lights with a wavelength "
                      "(Spectral); choose SecondOrder or FirstOrder for these");
        std::array<Double3, 3> second;
        count(apply(footprints, photon, &second), account);
        const double moment = std::remove_cvref_t<decltype(policies.kernel)>::second_moment;
        splatter.prepare(curved(*photon.deposit, second, policies.order, moment).pieces(), chunk, account);
    } else {
        count(apply(footprints, photon), account);
        prepare_splats(splatter, *photon.deposit, photon.parameters, chunk, account);
    }
}

/// The smoothing of photons without neighbours (Footprints::has_neighbours), by cross-validation.
template <class Footprints, class V, class F, class R, class Policies, class Photon, class E>
[[nodiscard]] double smoothing_without_neighbours(const Sums<V, F, R>& sums, const Policies& policies,
                                                  const Pilot<Photon>& pilot, const PhotonPass& pass, bool stratified,
                                                  E& executor) {
    const auto deposit_of = [&pilot](std::size_t i) {
        const Photon& photon = pilot.photons[i];
        return Footprints::has_neighbours(photon.sample) ? std::nullopt : photon.deposit;
    };
    return cross_validated(sums, policies, pilot.photons.size(), double(pass.emitted_in_all()), stratified, deposit_of,
                           executor);
}

/// Splats the photons of a pass, each with the footprint and the shift that the pilot's photons around it determine.
template <class S, class L, class V, class F, class R, class Policies, class Sequence, class E>
Statistics splat_to_second_order(const S& scene, const L& light, Sums<V, F, R>& sums, const PhotonPass& pass,
                                 const Policies& policies, const Sequence& sequence, E& executor) {
    const auto pilot = trace_pilot(scene, light, pass, policies.order, sequence, executor);
    auto footprints = fit_footprints<emission_domains<L>>(pilot, pass, policies, double(sums.map().diagonal()),
                                                          Sequence::stratified, executor);
    if constexpr (emission_domains<L>.others)
        if (!pass.smoothing)
            footprints.set_smoothing_without_neighbours(smoothing_without_neighbours<decltype(footprints)>(
                sums, policies, pilot, pass, Sequence::stratified, executor));
    if constexpr (emission_domains<L>.four)
        if (!pass.smoothing && std::isfinite(policies.order.largest_miss))
            choose_sizes(sums, policies, pilot, trace_held_out(scene, light, pass, pilot, sequence, executor), pass,
                         footprints, executor);
    Splatter splatter(sums, policies);
    TracedBatch<traced_photon_t<L>> batch;
    const auto trace_one = [&](std::uint64_t i, Statistics& account) {
        if (pilot.has(pass.first + i))
            return pilot.take(pass.first + i, account);
        PathTrail<typename L::vector> trail;
        auto photon = trace_photon(scene, light, pass, sequence, pass.first + i, account, trail);
        pilot.pieces.assign_piece(photon, trail.first());
        return photon;
    };
    return splat_in_batches(
        splatter, pass.count,
        [&](std::uint64_t i, auto& chunk, Statistics& account) {
            if (batch[i].deposit)
                prepare_shifted(footprints, batch[i], splatter, chunk, account);
        },
        executor,
        [&](std::uint64_t begin, std::uint64_t end) {
            return batch.trace(light, sequence, pass.first, begin, end, trace_one, executor);
        },
        pass.progress);
}

} // namespace nephroid::detail
