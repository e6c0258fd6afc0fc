// SPDX-License-Identifier: MIT
/// @file  Checks of the values that a renderer returns. A photon with a wrong value ends as Fate::invalid, so that a
///        mistake in an adapter shows in the account and not in the picture.
#pragma once

#include "nephroid/transport/scattering.hpp"

namespace nephroid::detail {

/// Whether a vector has unit length to 0.2%. A vector that is further off was never normalised.
template <Vector3 V>
[[nodiscard]] bool is_unit(const V& v) {
    using T = scalar_t<V>;
    return abs(length2(v) - T(1)) <= T(1) / T(256);
}

/// Whether a flux is negative; for a vector, in one of its bands.
template <Flux F>
[[nodiscard]] bool has_negative_band(const F& flux) {
    if constexpr (Scalar<F>) {
        return flux < F(0);
    } else if constexpr (Vector3<F>) {
        using t = vector_traits<F>;
        return t::x(flux) < 0 || t::y(flux) < 0 || t::z(flux) < 0;
    } else {
        return flux_traits<F>::power(flux) < 0;
    }
}

/// Whether a flux is more than `most` times another that has no negative bands; for a vector, in one of its bands.
template <Flux F>
[[nodiscard]] bool has_band_above(const F& flux, const F& other, double most) {
    const auto is_above = [most](auto a, auto b) { return double(a) > most * double(b); };
    if constexpr (Scalar<F>) {
        return is_above(flux, other);
    } else if constexpr (Vector3<F>) {
        using t = vector_traits<F>;
        return is_above(t::x(flux), t::x(other)) || is_above(t::y(flux), t::y(other)) ||
               is_above(t::z(flux), t::z(other));
    } else {
        return is_above(flux_traits<F>::power(flux), flux_traits<F>::power(other));
    }
}

/// Whether a refraction has a ratio of indices that is positive and finite. Other events need none.
template <Scalar T, class Scattering>
[[nodiscard]] bool has_valid_index([[maybe_unused]] const Scattering& scattering) {
    if constexpr (refracts<Scattering>)
        return scattering.event != Event::refract || (T(scattering.eta) > T(0) && isfinite(T(scattering.eta)));
    else
        return true;
}

} // namespace nephroid::detail
