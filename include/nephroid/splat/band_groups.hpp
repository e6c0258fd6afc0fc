// SPDX-License-Identifier: MIT
/// @file  The bands that a photon's path has light in, in groups that are splatted together.
#pragma once

#include "nephroid/emission/spectrum/wavelength.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace nephroid::detail {

/// Neighbouring bands that are splatted at one place.
template <class Spectrum>
struct BandGroup {
    std::size_t begin, end;                      ///< bands
    double steps;                                ///< how many ∂x/∂λ from the photon's place to the group's
    double width;                                ///< of one band, in ∂x/∂λ
    std::array<double, Spectrum::count> share{}; ///< by band: of the photon's flux in that band, 0 outside of the group
};

/// Calls use(group) for groups of bands, in order, whose places lie no further than `apart` from one another, in
/// ∂x/∂λ.
///
/// Bands beyond the wavelengths at which the photon's path exists get nothing, and those within get more, by one over
/// the share of the spectrum that takes this path: photons of the other wavelengths take another one.
template <class Spectrum, class Others, class Use>
void for_each_band_group(const Wavelength<Spectrum, Others>& photon, double apart, const Use& use) {
    constexpr auto count = Spectrum::count;
    const auto at = [&](double coordinate) { return photon.steps_to(photon.spectrum.wavelength(coordinate)); };
    double lowest = 0, highest = double(count);
    if (photon.shortest > 0)
        lowest = photon.spectrum.coordinate(photon.shortest);
    if (std::isfinite(photon.longest))
        highest = photon.spectrum.coordinate(photon.longest);
    double weight = double(count) / (highest - lowest);
    if (!std::isfinite(weight) || !(weight > 0)) { // one wavelength alone: its band stands for it
        lowest = std::floor((std::min)(photon.spectrum.coordinate(photon.wavelength), double(count) - 0.5));
        highest = lowest + 1;
        weight = double(count);
    }
    constexpr double sliver = 1e-6; // of a band: less is rounding of where it ends
    const auto last = (std::min)(count, static_cast<std::size_t>(std::ceil(highest - sliver)));
    for (auto first = static_cast<std::size_t>(lowest + sliver); first < last;) {
        BandGroup<Spectrum> group{first, first, 0, 0, {}};
        const double start = at(double(first) + 0.5);
        double end = start;
        do {
            const double b = double(group.end);
            group.share[group.end] = weight * ((std::min)(b + 1, highest) - (std::max)(b, lowest));
            end = at(b + 0.5);
            ++group.end;
        } while (group.end < last && std::abs(at(double(group.end) + 0.5) - start) <= apart);
        group.steps = 0.5 * (start + end);
        group.width = std::abs(at(double(group.end)) - at(double(first))) / double(group.end - first);
        use(group);
        first = group.end;
    }
}

} // namespace nephroid::detail
