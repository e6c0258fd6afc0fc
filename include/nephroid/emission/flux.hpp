// SPDX-License-Identifier: MIT
/// @file  What a flux is: a number, a colour, a spectrum.
#pragma once

#include "nephroid/vector/traits.hpp"

#include <concepts>

namespace nephroid {

/// Reads a user's flux type as one number, for the flux account and for Russian roulette. It is defined for scalars
/// (vector/scalar.hpp) and for every `Vector3` (an RGB colour in the renderer's own vector). Specialise it for another
/// type:
///
/// ```cpp
/// template <> struct nephroid::flux_traits<MySpectrum> {
///     static double power(const MySpectrum& f) { return f.mean(); } // watts: fixed, linear, not negative
///     static MySpectrum zero() { return MySpectrum(0.0f); }
/// };
/// ```
///
/// The type needs a + b, a * b band by band, and a * s for a number of the geometry's scalar type.
template <class F>
struct flux_traits;

template <Scalar F>
struct flux_traits<F> {
    [[nodiscard]] static constexpr double power(const F& f) { return double(f); }
    [[nodiscard]] static constexpr F zero() { return F(0); }
};

template <Vector3 F>
    requires(!Scalar<F>)
struct flux_traits<F> {
    using t = vector_traits<F>;
    [[nodiscard]] static constexpr double power(const F& f) {
        return (double(t::x(f)) + double(t::y(f)) + double(t::z(f))) / 3;
    }
    [[nodiscard]] static constexpr F zero() { return t::make(0, 0, 0); }
};

namespace detail {
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
} // namespace detail

/// A quantity of light: it adds, multiplies band by band (a weight is a flux as well), and has a power.
template <class F>
concept Flux = std::copyable<F> && detail::AddsAndMultiplies<F> && detail::HasPower<F>;

/// Scales a flux by a number of the geometry's scalar type.
template <class F, class T>
concept ScalesFlux = requires(const F f, const T s) {
    { (f * s) } -> std::convertible_to<F>;
};

namespace detail {
template <class F>
consteval bool explain_flux() {
    static_assert(std::copyable<F>, "nephroid: a flux must be copyable, and not const or a reference");
    static_assert(AddsAndMultiplies<F>,
                  "nephroid: the flux type lacks a + b or a * b of two fluxes (emission/flux.hpp)");
    static_assert(HasPower<F>, "nephroid: nephroid::flux_traits<F> is missing for this flux type, or its power(f) or "
                               "zero() (emission/flux.hpp)");
    return false;
}

template <class F, class V>
consteval bool explain_scaling() {
    static_assert(ScalesFlux<F, scalar_t<V>>,
                  "nephroid: the flux type lacks f * s with the vector's scalar (emission/flux.hpp)");
    return false;
}

/// For class templates: a flux that the vector's scalar scales, or an error that says why not.
template <class F, class V>
concept MustBeFluxFor = MustBeVector<V> &&(Flux<F> || explain_flux<F>()) &&
                        (ScalesFlux<F, scalar_t<V>> || explain_scaling<F, V>());
} // namespace detail

} // namespace nephroid
