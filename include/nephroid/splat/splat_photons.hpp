// SPDX-License-Identifier: MIT
/// @file  Splats photons that the caller has stored.
#pragma once

#include "nephroid/pass/call_arguments.hpp"
#include "nephroid/splat/splat_arguments.hpp"
#include "nephroid/splat/splat_in_batches.hpp"
#include "nephroid/vector/error.hpp"
#include "nephroid/vector/text.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>
#include <type_traits>

namespace nephroid {

/// Factors that are applied to stored photons as they are splatted.
struct Rescaling {
    double smoothing = 1; ///< of their tangents, > 0. For photons that were traced with smoothing 1 it is the smoothing
                          ///< s of the picture
    double flux = 1;      ///< of their fluxes, >= 0; for n of N photons it is N / n
};

namespace detail {
inline void check(const Rescaling& rescaling) {
    if (!(rescaling.smoothing > 0) || !std::isfinite(rescaling.smoothing))
        invalid_argument("nephroid::splat: smoothing is " + text_of(rescaling.smoothing) +
                         "; it must be positive and finite");
    if (!(rescaling.flux >= 0) || !std::isfinite(rescaling.flux))
        invalid_argument("nephroid::splat: flux is " + text_of(rescaling.flux) + "; it must not be negative");
}

template <Vector3 V, Flux F, std::size_t N>
[[nodiscard]] Deposit<V, F, N> rescaled(Deposit<V, F, N> deposit, const Rescaling& rescaling) {
    using T = scalar_t<V>;
    for (V& d : deposit.d_position)
        d = T(rescaling.smoothing) * d;
    deposit.flux = deposit.flux * T(rescaling.flux);
    return deposit;
}

template <class D, class V, class F>
inline constexpr bool is_deposit_of = false;
template <class V, class F, std::size_t N>
inline constexpr bool is_deposit_of<Deposit<V, F, N>, V, F> = true;

/// `photons[i]` is a deposit, `std::size(photons)` how many there are.
template <class P, class V, class F>
concept StoresPhotons = requires(const P& photons, std::size_t i) {
    { std::size(photons) } -> std::convertible_to<std::size_t>;
    requires is_deposit_of<std::remove_cvref_t<decltype(photons[i])>, V, F>;
};

template <class P, class V, class F>
consteval bool explain_stored_photons() {
    static_assert(StoresPhotons<P, V, F>,
                  "nephroid: the photons to splat must be an array of Deposit<V, F, N> (a vector or a span: size and "
                  "[]) with the vector and the flux type of the sums (splat/splat_photons.hpp)");
    return false;
}
template <class P, class V, class F>
concept MustStorePhotons = StoresPhotons<P, V, F> || explain_stored_photons<P, V, F>();
} // namespace detail

/// Splats stored photons to first order, each where it lies.
///
/// ```cpp
/// const auto traced = nephroid::trace_photons(scene, light, {.count = n, .smoothing = 1});
/// auto sums = nephroid::sums<float>(map);
/// nephroid::splat(traced.deposits, sums, {.smoothing = 8}, threads);
/// ```
///
/// @param photons    a range of deposits, from `trace_photons` or the renderer's own: a vector, an array, a span
/// @param rescaling  of their tangents and fluxes
/// @param arguments  optional, in any order: splat policies (otherwise `Published`), an executor. The sums are the same
///                   bit for bit with any executor
/// @return  what became of them: splatted, unseen, collapsed, excessive, invalid. Nothing counts as emitted
/// Throws std::invalid_argument for a rescaling that is not finite. Memory: one batch.
template <class Photons, class V, class F, class R, class... Arguments>
    requires(detail::MustStorePhotons<Photons, V, F>&&...&&
                 detail::MustBeOneOf<Arguments, detail::PoliciesKind, detail::ExecutorKind>)
Statistics splat(const Photons& photons, Sums<V, F, R>& sums, const Rescaling& rescaling = {},
                 Arguments&&... arguments) {
    detail::check(rescaling);
    return detail::with_splat_arguments<Published>(
        [&](const auto& policies, const auto&, auto& executor) {
            detail::Splatter splatter(sums, policies);
            return detail::splat_in_batches(
                splatter, std::size(photons),
                [&](std::uint64_t i, auto& chunk, Statistics& account) {
                    splatter.prepare(detail::rescaled(photons[std::size_t(i)], rescaling), chunk, account);
                },
                executor);
        },
        arguments...);
}

} // namespace nephroid
