// SPDX-License-Identifier: MIT
/// @file  A light whose photons carry no differentials, for methods that need no footprints.
#pragma once

#include "nephroid/emission/light.hpp"
#include "nephroid/emission/parameters.hpp"

#include <cstddef>
#include <type_traits>
#include <utility>

namespace nephroid {

namespace detail {
/// Declares the same emission domain as a light.
template <class L>
struct DomainLike {
    static constexpr EmissionDomains domains = emission_domains<L>;
};
template <DeclaresDomain L>
struct DomainLike<L> {
    static constexpr EmissionDomain domain = L::domain;
};
} // namespace detail

/// Emits the light's photons with the same positions, directions and fluxes, bit for bit, but with N = 0 tangents,
/// which saves the time of carrying them along. It is a `PhotonSource`, but not a `Light`, whose photons have two or
/// more.
///
/// ```cpp
/// const auto traced = nephroid::trace_photons(scene, nephroid::WithoutTangents(light), pass, sequence, executor);
/// ```
template <Light L>
class WithoutTangents : public detail::DomainLike<L> {
    static_assert(std::is_same_v<detail::parameters_t<L>, NoParameters>,
                  "nephroid: photons of Spectral and Extended lights are not the same without tangents: leave "
                  "WithoutTangents out, or give it the light within");

public:
    using vector = typename L::vector;
    using flux_type = typename L::flux_type;

    explicit WithoutTangents(L light) : light_(std::move(light)) {}

    template <class S>
    [[nodiscard]] Photon<vector, flux_type, 0> emit(S& samples, const Spread<scalar_t<vector>>& spread) const {
        const auto photon = light_.emit(samples, spread);
        return {photon.position, photon.direction, photon.flux, {}};
    }

    [[nodiscard]] EmissionDomain exact_domain() const requires detail::DeclaresDomain<L> { return domain_of(light_); }
    template <class S>
        requires requires(const L& light, S& samples) { light.draw_coordinates(samples); }
    void draw_coordinates(S& samples) const { light_.draw_coordinates(samples); }

    [[nodiscard]] double power() const { return double(light_.power()); }
    [[nodiscard]] const L& light() const { return light_; }

private:
    L light_;
};

namespace detail {
template <class L>
inline constexpr bool is_without_tangents = false;
template <Light L>
inline constexpr bool is_without_tangents<WithoutTangents<L>> = true;

template <class L>
concept EmitsWithoutTangents = is_without_tangents<L>;
} // namespace detail

/// A source of photons, with differentials or without.
template <class L>
concept PhotonSource = Light<L> || detail::EmitsWithoutTangents<L>;

namespace detail {
/// The number of tangents of a source's photons.
template <class L>
inline constexpr std::size_t tangent_count_of = emitted_t<L>::tangent_count;

/// A source of photons for these sums, or an error that says why not.
template <class L, class V, class F>
concept MustEmit = (PhotonSource<L> || explain_light<L>()) &&
                   (EmitsFor<L, V, F> || explain_emission<L, V, F>()) && MustDeclareDomain<L>;
} // namespace detail

} // namespace nephroid
