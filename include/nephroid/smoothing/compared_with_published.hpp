// SPDX-License-Identifier: MIT
/// @file  A safety net for lamps with area: whether the published footprints make a better picture than those chosen.
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
#include <optional>

namespace nephroid::detail {

/// The squared error of a pass, summed over the vertices, plus a constant: from pictures of a part of its photons with
/// the footprints of the pass. Photons in four coordinates are nearly random, and the variance falls with their number.
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

/// Whether the pilot's photons of lamps with area, splatted as published, predict each other better than with the
/// footprints chosen for them.
///
/// @param footprints  of a pass whose smoothing is not given
/// @return  false if too few photons land in view to tell
template <class V, class F, class R, class Policies, class Photon, class Footprints, class E>
[[nodiscard]] bool is_published_better(const Sums<V, F, R>& sums, const Policies& policies, const Pilot<Photon>& pilot,
                                       const Footprints& footprints, const PhotonPass& pass, E& executor) {
    constexpr double sharpest = 2.5;
    constexpr std::size_t fewest = 256; // photons that must land
    const auto as_published = [&](std::size_t i) {
        const Photon& photon = pilot.photons[i];
        return photon.sample.coordinates == 4 ? photon.deposit : std::nullopt;
    };
    const auto as_chosen = [&](std::size_t i) {
        Photon photon = pilot.photons[i];
        if (photon.sample.coordinates != 4)
            photon.deposit.reset();
        if (photon.deposit)
            (void)footprints.apply(photon);
        return photon.deposit;
    };
    const std::size_t count = pilot.photons.size();
    std::size_t landed = 0;
    for (std::size_t i = 0; i < count && landed < fewest; ++i)
        landed += as_published(i).has_value();
    if (landed < fewest)
        return false;

    announce(executor, Phase::fit);
    const double photons = double(pass.emitted_in_all()), share = double(count) / photons;
    const double whole = std::sqrt(double(count / 4 * 4) / photons); // undoes what widens the footprints of a part
    QuarterSplatter published(sums, policies, count, photons, as_published, executor);
    QuarterSplatter chosen(sums, policies, count, photons, as_chosen, executor);
    const QuarterPictures sharp = published(sharpest);
    return validated_error_of_pass(published(default_smoothing * whole), sharp, share) <
           validated_error_of_pass(chosen(whole), sharp, share);
}

} // namespace nephroid::detail
