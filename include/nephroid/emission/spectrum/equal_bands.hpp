// SPDX-License-Identifier: MIT
/// @file  How a spectrum is divided into bands.
#pragma once

#include "nephroid/vector/language.hpp"

#include <algorithm>
#include <concepts>
#include <cstddef>

namespace nephroid {

/// A spectrum cut into `count` bands. `wavelength(c)` is the wavelength at the coordinate c in [0, count], rising; band
/// b lies between those at b and b + 1. `coordinate(wavelength)` is its inverse, clamped to [0, count]. The unit is the
/// scene's own, the same as in the scene's ∂η/∂λ; nanometres, say.
template <class S>
concept DividesSpectrum = std::semiregular<S> && requires(const S& spectrum, double number) {
    { S::count } -> std::convertible_to<std::size_t>;
    { spectrum.wavelength(number) } -> std::convertible_to<double>;
    { spectrum.coordinate(number) } -> std::convertible_to<double>;
};

/// B bands of equal width.
template <std::size_t B>
    requires(B >= 1)
struct EqualBands {
    static constexpr std::size_t count = B;

    double shortest = 400; ///< where the first band begins, > 0
    double longest = 700;  ///< where the last band ends, > shortest

    [[nodiscard]] constexpr double wavelength(double coordinate) const {
        return shortest + (longest - shortest) * (coordinate / double(B));
    }
    [[nodiscard]] constexpr double coordinate(double wavelength) const {
        return (std::clamp)(double(B) * (wavelength - shortest) / (longest - shortest), 0.0, double(B));
    }
};

} // namespace nephroid
