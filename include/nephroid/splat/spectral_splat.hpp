// SPDX-License-Identifier: MIT
/// @file  A photon of one wavelength splatted in all bands, each where the photon's tangent says that it lands.
#pragma once

#include "nephroid/emission/spectrum/wavelength.hpp"
#include "nephroid/footprint/kernel.hpp"
#include "nephroid/splat/band_groups.hpp"
#include "nephroid/splat/splatter.hpp"
#include "nephroid/transport/deposit.hpp"

#include <concepts>
#include <cstddef>
#include <limits>
#include <type_traits>

namespace nephroid::detail {

/// Moves a deposit along its tangent by wavelength to where the middle of the spectrum lands, so that photons that
/// differ in their wavelengths alone lie at one place.
template <Vector3 V, Flux F, std::size_t N, class Spectrum, class Others>
void move_to_middle(Deposit<V, F, N>& deposit, Wavelength<Spectrum, Others>& photon) {
    const double steps = photon.steps_to(photon.spectrum.wavelength(0.5 * double(Spectrum::count)));
    const V there = deposit.position + scalar_t<V>(steps) * deposit.d_position[N - 1];
    if (!all_finite(there))
        return;
    deposit.position = there;
    photon.moved += steps;
}

/// Splats a photon's bands in groups. Each group is the photon's own footprint, moved along the tangent by wavelength
/// and widened by what one band spreads [include/nephroid/README.md, "Wavelengths"].
///
/// @param deposit  its last tangent is by wavelength
template <class V, class F, class R, class Policies, std::size_t N, class Spectrum, class Others>
    requires(N >= 3)
void prepare_bands(const Splatter<V, F, R, Policies>& splatter, const Deposit<V, F, N>& deposit,
                   const Wavelength<Spectrum, Others>& photon, SplatChunk<V, F>& chunk, Statistics& account) {
    using T = scalar_t<V>;
    using Kernel = std::remove_cvref_t<decltype(splatter.policies().kernel)>;
    const V streak = deposit.d_position[N - 1]; // ∂x/∂λ
    const T length_of_streak = length(streak);
    if (!isfinite(length_of_streak) || !all_finite(deposit.position)) {
        splatter.prepare(deposit, chunk, account); // which books it as invalid
        return;
    }
    // Bands closer together than a fifth of what the filtered footprint covers along the streak are splatted as one. At
    // a focus all bands of a group shift the same way: with a half the error there is four times as large.
    T covered2(0);
    for (std::size_t i = 0; i + 1 < N; ++i)
        covered2 = covered2 + square(T(0.5) * dot(deposit.d_position[i], streak));
    T reach = length_of_streak > T(0) ? sqrt(covered2) / length_of_streak : T(0);
    if constexpr (requires { splatter.policies().filter.width_scale; })
        reach = sqrt(square(reach) + square(T(pixel_filter_width<Kernel> * splatter.policies().filter.width_scale) *
                                            splatter.map().spacing_at(deposit.position)));
    // Where nothing disperses there is no streak, and all bands are one group.
    const double apart =
        length_of_streak > T(0) ? 0.2 * double(reach) / double(length_of_streak) : (std::numeric_limits<double>::max)();

    const double emitted = double(flux_traits<F>::power(deposit.flux));
    const double splatted = splatter.prepare_each(
        [&](const auto& use) {
            Deposit<V, F, N> piece = deposit;
            for_each_band_group(photon, apart, [&](const BandGroup<Spectrum>& group) {
                F share = flux_traits<F>::zero();
                for (std::size_t b = group.begin; b < group.end; ++b)
                    share[int(b)] = std::remove_cvref_t<decltype(share[int(b)])>(group.share[b]);
                piece.flux = deposit.flux * share;
                piece.position = deposit.position + T(group.steps) * streak;
                // The variance of a box, as the pixel filter has it, from a full tangent: twice the semi-axis.
                piece.d_position[N - 1] = T(2 * pixel_filter_width<Kernel> * group.width) * streak;
                use(piece);
            });
        },
        chunk, account);
    // What the photon lends to bands that take another path is paid back by photons of these.
    if (photon.shortest > 0 || std::isfinite(photon.longest))
        account.lose(Fate::terminated, emitted - splatted);
}

} // namespace nephroid::detail
