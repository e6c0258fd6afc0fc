// SPDX-License-Identifier: MIT
/// @file  A safety net for lamps with area: how large their footprints are, or whether they are splatted as published.
///
/// Tangents do not tell where light jumps from one flat facet to the next, and in four emission coordinates photons are
/// too far from each other to see it in where they land. Pictures do: those of the pilot, with footprints of several
/// sizes and with the published ones, are compared with a sharp picture of photons that are independent of it.
/// Derivation: include/nephroid/README.md, "Lamps with area: the size by pictures".
#pragma once

#include "nephroid/sequence/hash.hpp"
#include "nephroid/smoothing/held_out_picture.hpp"
#include "nephroid/smoothing/pilot.hpp"
#include "nephroid/smoothing/quarter_pictures.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace nephroid::detail {

/// A photon to judge footprints by.
template <class Deposit>
struct HeldOutPhoton {
    std::optional<Deposit> deposit; ///< emitted with smoothing 1
    std::uint32_t light = 0;
};

/// As many photons as the pilot has, but independent of the pass: their indices are drawn at random. The halves of a
/// stratified sequence are not independent. They fill each other's gaps, and how well depends on the scene.
template <class S, class L, class Photon, class Sequence, class E>
[[nodiscard]] auto trace_held_out(const S& scene, const L& light, const PhotonPass& pass, const Pilot<Photon>& pilot,
                                  const Sequence& sequence, E& executor) {
    using Deposit = typename decltype(Photon::deposit)::value_type;
    constexpr std::size_t fewest = std::size_t(1) << 14; // fewer know too little of a sharp focus
    std::vector<HeldOutPhoton<Deposit>> photons((std::max)(pilot.photons.size(), fewest));
    announce(executor, Phase::trace);
    for_each_index(executor, photons.size(), 512, [&](std::size_t i) {
        const std::uint64_t index = hash_bits(pilot.first, i) >> 32; // no sequence is asked for more than 2³² photons
        Statistics unused;
        PathTrail<typename L::vector> trail;
        const auto photon = trace_photon(scene, light, pass, sequence, index, unused, trail);
        photons[i] = {photon.deposit, photon.sample.light};
    });
    return photons;
}

/// Chooses for each lamp with area how large its footprints are, over those that the field chose; or the published
/// ones, unless others are better beyond doubt.
///
/// @param held_out    of trace_held_out
/// @param footprints  of a pass whose smoothing is not given
template <class V, class F, class R, class Policies, class Photon, class Deposit, class Footprints, class E>
void choose_sizes(const Sums<V, F, R>& sums, const Policies& policies, const Pilot<Photon>& pilot,
                  const std::vector<HeldOutPhoton<Deposit>>& held_out, const PhotonPass& pass, Footprints& footprints,
                  E& executor) {
    constexpr double sharpest = 2.5; // as cross_validated has it
    constexpr double least_size = 0.2, step = 0.7071;
    std::set<std::uint32_t> lamps;
    for (const Photon& photon : pilot.photons)
        if (photon.sample.coordinates == 4 && photon.deposit)
            lamps.insert(photon.sample.light);
    announce(executor, Phase::fit);
    const auto silent = [&executor](std::size_t count, const auto& task) { executor(count, task); };
    const std::size_t count = pilot.photons.size();
    const double photons = double(pass.emitted_in_all()), share = double(count) / photons;
    const double whole = std::sqrt(double(count / 4 * 4) / photons); // undoes what widens the footprints of a part
    std::vector<std::optional<FieldSample>> chosen(lamps.empty() ? 0 : count);
    for_each_index(executor, chosen.size(), 512, [&](std::size_t i) {
        if (pilot.photons[i].deposit && pilot.photons[i].sample.coordinates == 4)
            chosen[i] = footprints.chosen_by_field(pilot.photons[i]);
    });
    for (const std::uint32_t lamp : lamps) {
        const auto held_out_deposit = [&](std::size_t i) {
            return held_out[i].light == lamp ? held_out[i].deposit : std::nullopt;
        };
        const auto deposit = [&](std::size_t i) {
            Photon photon = pilot.photons[i];
            if (photon.sample.coordinates != 4 || photon.sample.light != lamp)
                photon.deposit.reset();
            else if (photon.deposit)
                (void)footprints.apply(photon, chosen[i]); // pieces of curved footprints are compared as one
            return photon.deposit;
        };
        QuarterSplatter splat_held_out(sums, policies, held_out.size(), photons, held_out_deposit, silent);
        QuarterSplatter splat(sums, policies, count, photons, deposit, silent);
        const HeldOutPicture sharp(splat_held_out(sharpest));
        footprints.set_size(lamp, 0);
        const QuarterPictures published = splat(whole);
        double part = 0; // of a picture's variance that more photons take away
        if (share < 1) {
            const auto stratification = sharp.stratification(published, splat_held_out(default_smoothing * whole));
            if (!stratification)
                continue;
            part = (1 - share) * *stratification;
        }
        std::vector<double> best;
        double best_size = 0, least_error = std::numeric_limits<double>::infinity();
        for (double size = 1; size > least_size; size *= step) {
            footprints.set_size(lamp, size);
            const QuarterPictures quarters = splat(whole);
            std::vector<double> picture = mean_of(quarters);
            const double error = sharp.error(picture) - part * variance_of_mean(quarters);
            if (!(error < least_error))
                break;
            best_size = size, least_error = error, best = std::move(picture);
        }
        const std::vector<double> picture = mean_of(published);
        const double error = sharp.error(picture) - part * variance_of_mean(published);
        const bool is_better = !best.empty() && least_error + sharp.standard_error(best, picture) < error;
        footprints.set_size(lamp, is_better ? best_size : 0);
    }
}

} // namespace nephroid::detail
