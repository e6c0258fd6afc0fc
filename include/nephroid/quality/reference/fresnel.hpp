// SPDX-License-Identifier: MIT
/// @file  The fraction of unpolarised light that passes from one dielectric into another. The references have their
///        own, so that they share no formula with what they check.
#pragma once

#include "nephroid/vector/language.hpp"

#include <cmath>

namespace nephroid::reference::detail {

/// The power transmittance of a smooth interface between dielectrics for unpolarised light, by Fresnel's formulas.
///
/// @param sin_in  sine of the angle of incidence, 0 to 1, with sin_in < index
/// @param index   refractive index behind the interface over that before it, > 0
/// @return  1 minus the mean of the two reflectances, 0 to 1. The same for the way back along the same two angles.
[[nodiscard]] inline double transmittance(double sin_in, double index) {
    const double cos_in = std::sqrt((std::fmax)(0.0, 1 - sin_in * sin_in));
    const double sin_out = sin_in / index;
    const double cos_out = std::sqrt(1 - sin_out * sin_out);
    const double s = (cos_in - index * cos_out) / (cos_in + index * cos_out);
    const double p = (index * cos_in - cos_out) / (index * cos_in + cos_out);
    return 1 - 0.5 * (s * s + p * p);
}

} // namespace nephroid::reference::detail
