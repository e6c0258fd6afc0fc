// SPDX-License-Identifier: MIT
/// @file  A safety net for lamps with area: which are better splatted as published than with the footprints chosen.
///
/// Tangents do not tell where light jumps from one flat facet to the next, and in four emission coordinates photons are
/// too far from each other to see it in where they land. Pictures do: those of one half of the photons predict those of
/// the other [cross_validation.hpp].
#pragma once

#include "nephroid/smoothing/cross_validation.hpp"
#include "nephroid/smoothing/pilot.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace nephroid::detail {

/// The squared error of a pass, summed over the vertices, plus a constant: from pictures of a part of its photons with
/// the footprints of the pass. In four coordinates even photons of a stratified sequence are nearly random, so that
/// halves are independent and the variance falls with the number of photons.
///
/// @param sharp  pictures of the same quarters with small footprints
/// @param share  of the pass's photons that the pictures are made of, in (0, 1]
[[nodiscard]] inline double validated_error_of_pass(const QuarterPictures& q, const QuarterPictures& sharp,
                                                    double share) {
    double variance = 0; // of the picture from all quarters
    for (std::size_t i = 0; i < q[0].size(); ++i)
        variance += square(0.25 * ((q[0][i] + q[1][i]) - (q[2][i] + q[3][i])));
    return validated_error(q, sharp, 1) - (1 - share) * variance;
}

/// Whether photons of one lamp with area, splatted as published, predict each other better than with the footprints
/// chosen for them: as a mean over the three ways to pair their quarters to halves. (Pieces of curved footprints are
/// compared as one.)
///
/// @param picture_of  picture_of(smoothing, is_chosen) -> QuarterPictures
/// @param share       of the pass's photons that are in the pictures
/// @param whole       undoes what widens the footprints of a part
template <class PictureOf>
[[nodiscard]] bool is_published_better(const PictureOf& picture_of, double share, double whole) {
    constexpr double sharpest = 2.5; // as cross_validated has it
    const QuarterPictures sharp = picture_of(sharpest, false);
    const QuarterPictures published = picture_of(default_smoothing * whole, false);
    const QuarterPictures chosen = picture_of(whole, true);
    double lead = 0;
    for (std::size_t with_first = 1; with_first < 4; ++with_first) {
        const auto paired = [with_first](QuarterPictures q) {
            std::swap(q[1], q[with_first]);
            return q;
        };
        lead += validated_error_of_pass(paired(chosen), paired(sharp), share) -
                validated_error_of_pass(paired(published), paired(sharp), share);
    }
    return lead > 0;
}

/// The lamps with area, by number, that are better splatted as published; rising.
///
/// @param footprints  of a pass whose smoothing is not given
template <class V, class F, class R, class Policies, class Photon, class Footprints, class E>
[[nodiscard]] std::vector<std::uint32_t>
lamps_better_published(const Sums<V, F, R>& sums, const Policies& policies, const Pilot<Photon>& pilot,
                       const Footprints& footprints, const PhotonPass& pass, E& executor) {
    constexpr std::size_t fewest = 1000; // photons of a lamp that must land, to tell
    std::map<std::uint32_t, std::size_t> landed;
    for (const Photon& photon : pilot.photons)
        if (photon.sample.coordinates == 4 && photon.deposit)
            ++landed[photon.sample.light];
    std::vector<std::uint32_t> published;
    if (landed.empty())
        return published;
    announce(executor, Phase::fit);
    const auto silent = [&executor](std::size_t count, const auto& task) { executor(count, task); };
    const std::size_t count = pilot.photons.size();
    const double photons = double(pass.emitted_in_all());
    std::uint32_t lamp = 0;
    bool is_chosen = false;
    const auto deposit_of = [&](std::size_t i) {
        Photon photon = pilot.photons[i];
        if (photon.sample.coordinates != 4 || photon.sample.light != lamp)
            photon.deposit.reset();
        else if (photon.deposit && is_chosen)
            (void)footprints.apply(photon);
        return photon.deposit;
    };
    QuarterSplatter splat(sums, policies, count, photons, deposit_of, silent);
    const auto picture_of = [&](double smoothing, bool chosen) {
        is_chosen = chosen;
        return splat(smoothing);
    };
    for (const auto& [number, deposits] : landed) {
        lamp = number;
        if (deposits >= fewest &&
            is_published_better(picture_of, double(count) / photons, std::sqrt(double(count / 4 * 4) / photons)))
            published.push_back(number);
    }
    return published;
}

} // namespace nephroid::detail
