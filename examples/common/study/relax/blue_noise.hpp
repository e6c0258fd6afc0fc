// SPDX-License-Identifier: MIT
/// @file  How blue the noise of evenly lit photons is: spectra of windows cut out of the floor.
#pragma once

#include "common/study/relax/subject.hpp"

#include "nephroid/quality/spectrum.hpp"

#include <array>
#include <vector>

namespace nephroid::examples::study::relax {

/// Windows whose periodograms are averaged, as many as Ulichney 1988 takes: white noise has an anisotropy of -10 dB.
inline constexpr std::size_t spectral_windows = 10;

struct BlueNoise {
    PowerSpectrum spectrum;
    std::vector<Annulus> annuli;
    double principal;        ///< frequency, cycles per window
    double low_power;        ///< mean of 0 < |f| < principal / 2, but for the frequencies that the window blurs into 0
    double anisotropy;       ///< mean of all frequencies from there to twice the principal one
    double worst_anisotropy; ///< of the annuli with at least 64 frequencies

    [[nodiscard]] static constexpr double least_frequency() { return 2.5; }
};

/// The spectrum of the photons on a part of the floor z = 0: square windows of a 4 × 4 grid in its middle, each faded
/// to its border and scaled to the unit square. Frequencies up to twice the principal one of a window.
/// Throws std::runtime_error if a window holds fewer than 16 photons.
[[nodiscard]] BlueNoise blue_noise(const std::vector<StoredPhoton>& photons, const std::array<double, 4>& floor,
                                   ThreadExecutor& threads);

} // namespace nephroid::examples::study::relax
