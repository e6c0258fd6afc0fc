// SPDX-License-Identifier: MIT
/// @file  The bands of a flux as numbers, for sums that are not made of fluxes.
#pragma once

#include "nephroid/vector/traits.hpp"

#include <array>
#include <concepts>
#include <cstddef>

namespace nephroid {

/// The bands of a flux, for accumulators. It is defined for scalars and for every `Vector3`. Specialise it for another
/// type: `count`, `of(flux) -> std::array<double, count>` and `flux(bands) -> F`.
template <class F>
struct flux_bands;

template <Scalar F>
struct flux_bands<F> {
    static constexpr std::size_t count = 1;
    [[nodiscard]] static constexpr std::array<double, 1> of(const F& f) { return {double(f)}; }
    [[nodiscard]] static constexpr F flux(const std::array<double, 1>& bands) { return F(bands[0]); }
};

template <Vector3 F>
    requires(!Scalar<F>)
struct flux_bands<F> {
    using t = vector_traits<F>;
    static constexpr std::size_t count = 3;
    [[nodiscard]] static constexpr std::array<double, 3> of(const F& f) {
        return {double(t::x(f)), double(t::y(f)), double(t::z(f))};
    }
    [[nodiscard]] static constexpr F flux(const std::array<double, 3>& bands) {
        return t::make(scalar_t<F>(bands[0]), scalar_t<F>(bands[1]), scalar_t<F>(bands[2]));
    }
};

namespace detail {
template <class F>
concept HasBands = requires(const F f) {
    { flux_bands<F>::flux(flux_bands<F>::of(f)) } -> std::convertible_to<F>;
};

template <class F>
consteval bool explain_bands() {
    static_assert(HasBands<F>,
                  "nephroid: nephroid::flux_bands<F> is missing for this flux type, or its count, of(f) or "
                  "flux(bands): InDouble and InWholeNumbers add band by band (receiver/flux_bands.hpp)");
    return false;
}

template <class F>
concept MustHaveBands = HasBands<F> || explain_bands<F>();
} // namespace detail

} // namespace nephroid
