// SPDX-License-Identifier: MIT
/// @file  What a flux is: a number, a colour, a spectrum.
#pragma once

#include "nephroid/vector/traits.hpp"

#include <concepts>

namespace nephroid {

/// How the library reads a user's flux type where one number is needed: for the flux account and for Russian
/// roulette. Floating-point flux and any `Vector3` (an RGB colour in the renderer's own vector) come along; another
/// type specialises this with
///
/// ```cpp
/// static double power(const MySpectrum& f);   // watts: a fixed non-negative linear function, say the bands' mean
/// static MySpectrum zero();
/// ```
template <class F>
struct flux_traits;

template <class F>
    requires std::floating_point<F>
struct flux_traits<F> {
    [[nodiscard]] static constexpr double power(F f) { return double(f); }
    [[nodiscard]] static constexpr F zero() { return F(0); }
};

template <Vector3 F>
    requires(!std::floating_point<F>)
struct flux_traits<F> {
    using t = vector_traits<F>;
    [[nodiscard]] static constexpr double power(const F& f) {
        return (double(t::x(f)) + double(t::y(f)) + double(t::z(f))) / 3;
    }
    [[nodiscard]] static constexpr F zero() { return t::make(0, 0, 0); }
};

template <class F>
concept HasPower = requires(const F f) {
    { flux_traits<F>::power(f) } -> std::convertible_to<double>;
    { flux_traits<F>::zero() } -> std::convertible_to<F>;
};

template <class F>
concept AddsAndMultiplies = requires(const F a, const F b) {
    { (a + b) } -> std::convertible_to<F>;
    { (a * b) } -> std::convertible_to<F>;
};

/// A quantity of light: it adds, multiplies band by band (a weight is a flux as well), and has a power.
template <class F>
concept Flux = std::copyable<F> && AddsAndMultiplies<F> && HasPower<F>;

/// Scales a flux by a number of the geometry's scalar type.
template <class F, class T>
concept ScalesFlux = requires(const F f, const T s) {
    { (f * s) } -> std::convertible_to<F>;
};

} // namespace nephroid
