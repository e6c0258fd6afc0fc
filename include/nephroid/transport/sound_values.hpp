// SPDX-License-Identifier: MIT
/// @file  What a renderer's answers must be for a photon to go on by them; those of a photon that may not end it as
///        Fate::invalid, so that a mistake in an adapter is counted and never drawn.
#pragma once

#include "nephroid/transport/scattering.hpp"

namespace nephroid::detail {

/// To 0.2%: what is further off was never normalised.
template <Vector3 V>
[[nodiscard]] bool is_unit(const V& v) {
    using T = scalar_t<V>;
    return abs(length2(v) - T(1)) <= T(1) / T(256);
}

/// Negative light, in a band at least where the flux is a vector.
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

/// A refraction needs a ratio of indices that is positive and finite; other events have none.
template <Scalar T, class Scattering>
[[nodiscard]] bool has_index([[maybe_unused]] const Scattering& scattering) {
    if constexpr (refracts<Scattering>)
        return scattering.event != Event::refract || (T(scattering.eta) > T(0) && isfinite(T(scattering.eta)));
    else
        return true;
}

} // namespace nephroid::detail
