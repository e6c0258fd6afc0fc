// SPDX-License-Identifier: MIT
/// @file  Fresnel's formulas: how much unpolarised light a smooth interface reflects.
#pragma once

#include <cmath>
#include <complex>
#include <concepts>

namespace nephroid::examples {

/// The reflectance of an interface between two dielectrics; the rest is transmitted.
///
/// @param cos_incident  between the ray and the normal on its side, 0 to 1
/// @param eta           n₁/n₂: the index on the ray's side over that on the other side, > 0
/// @return  0 to 1; exactly 1 at grazing incidence and from the critical angle on
template <std::floating_point T>
[[nodiscard]] T dielectric_reflectance(T cos_incident, T eta) {
    const T sin2_refracted = eta * eta * (T(1) - cos_incident) * (T(1) + cos_incident);
    if (sin2_refracted >= T(1))
        return T(1);
    const T cos_refracted = std::sqrt(T(1) - sin2_refracted);
    const T s = (eta * cos_incident - cos_refracted) / (eta * cos_incident + cos_refracted);
    const T p = (cos_incident - eta * cos_refracted) / (cos_incident + eta * cos_refracted);
    return T(0.5) * (s * s + p * p);
}

/// The reflectance of a metal.
///
/// @param cos_incident  between the ray and the normal, 0 to 1
/// @param eta,k         real and imaginary part of the metal's index over that of the medium before it, >= 0, not both
///        0
/// @return  0 to 1
template <std::floating_point T>
[[nodiscard]] T conductor_reflectance(T cos_incident, T eta, T k) {
    using C = std::complex<T>;
    const C index(eta, k);
    const C cos_refracted = std::sqrt(C(1) - (T(1) - cos_incident) * (T(1) + cos_incident) / (index * index));
    const C s = (cos_incident - index * cos_refracted) / (cos_incident + index * cos_refracted);
    const C p = (index * cos_incident - cos_refracted) / (index * cos_incident + cos_refracted);
    return T(0.5) * (std::norm(s) + std::norm(p));
}

} // namespace nephroid::examples
