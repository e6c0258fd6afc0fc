// SPDX-License-Identifier: MIT
/// @file  A photon's wavelength, from which the places of all bands are predicted.
#pragma once

#include "nephroid/emission/parameters.hpp"
#include "nephroid/emission/spectrum/equal_bands.hpp"
#include "nephroid/vector/scalar.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace nephroid {

/// A photon's parameters: its own wavelength λ, within the spectrum that its flux has the bands of. Its last tangent
/// is by λ, zero at the lamp.
///
/// At another wavelength λ' the photon lands at x + `steps_to(λ')` ∂x/∂λ. This is linear in λ⁻², as Cauchy's
/// index of refraction is, whatever the number of glasses [include/nephroid/README.md, "Wavelengths"].
///
/// @tparam Others  the other parameters of the photon; their tangents stand before that by λ
template <DividesSpectrum Spectrum, class Others = NoParameters>
struct Wavelength {
    static constexpr auto tangents = [] {
        std::array<TangentKind, Others::tangents.size() + 1> kinds{};
        std::copy(Others::tangents.begin(), Others::tangents.end(), kinds.begin());
        kinds.back() = TangentKind::wavelength;
        return kinds;
    }();
    using spectrum_type = Spectrum;

    double wavelength; ///< λ, > 0
    Spectrum spectrum;
    /// Between these wavelengths the photon's path exists. The walk narrows them where glass reflects all light.
    double shortest = 0, longest = std::numeric_limits<double>::infinity();
    [[no_unique_address]] Others others{};
    double moved = 0; ///< how many ∂x/∂λ the deposit has been moved along its tangent

    [[nodiscard]] double steps_to(double other) const {
        const double ratio = wavelength / other;
        return 0.5 * wavelength * (1 - ratio) * (1 + ratio) - moved;
    }

    /// Notes a refraction or a total reflection.
    ///
    /// @param cos2       1 − η² sin² at the surface: the refracted angle's squared cosine, negative beyond the
    ///                   critical angle
    /// @param d_cos2     its derivative by λ
    void meet_glass(double cos2, double d_cos2) {
        const double steps = -cos2 / d_cos2; // to the wavelength at which it changes its sign
        const double inverse2 = 1 - 2 * steps / wavelength;
        if (!(inverse2 > 0) || !std::isfinite(inverse2)) // at no wavelength
            return;
        const double critical = wavelength / std::sqrt(inverse2);
        if (critical > wavelength)
            longest = (std::min)(longest, critical);
        else
            shortest = (std::max)(shortest, critical);
    }
};

} // namespace nephroid
