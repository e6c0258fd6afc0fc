// SPDX-License-Identifier: MIT
/// @file  The concept of a light: it emits photons, and estimates its power.
#pragma once

#include "nephroid/emission/domain.hpp"
#include "nephroid/emission/parameters.hpp"
#include "nephroid/emission/photon.hpp"
#include "nephroid/emission/spread.hpp"

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace nephroid {

/// A stream of numbers in [0, 1): `source.template next<T>()`, such as a `Sampler` (sequence/sequence.hpp).
template <class S, class T>
concept SampleSource = requires(S source) {
    { source.template next<T>() } -> std::convertible_to<T>;
};

namespace detail {
struct AnySampleSource { // declared for concepts, never called
    template <class T>
    T next();
};

template <class L>
concept HasVectorAndFlux = Vector3<typename L::vector> && Flux<typename L::flux_type>;

template <class P, class L>
inline constexpr bool is_photon_of = false;
template <class L, std::size_t N>
inline constexpr bool is_photon_of<Photon<typename L::vector, typename L::flux_type, N>, L> = N >= 2;
template <class L, std::size_t N, class P>
inline constexpr bool is_photon_of<ParametricPhoton<typename L::vector, typename L::flux_type, N, P>, L> =
    N - P::tangents.size() >= 2 && N >= P::tangents.size();

template <class P, class L>
concept PhotonOf = is_photon_of<P, L>;

template <class L>
concept EmitsPhotons = requires(const L light, AnySampleSource& samples,
                                const Spread<scalar_t<typename L::vector>> spread) {
    { light.emit(samples, spread) } -> PhotonOf<L>;
};

template <class L>
concept EstimatesPower = requires(const L light) {
    { light.power() } -> std::convertible_to<double>;
};
} // namespace detail

/// A light source. Its members:
///
/// - `vector` and `flux_type`
/// - `emit(samples, spread) -> Photon`: emits one of `spread.photons` photons, whose fluxes add up, on average, to the
///   flux that the light sends into its domain. It draws the same number of samples each time, those of the position
///   first. The first two tangents are orthogonal and aligned at emission (emission/aligned_basis.hpp); a light may add
///   more. It does not throw; a photon's flux may be zero.
/// - `domain`, optional, `static constexpr EmissionDomain`: which of the samples are a photon's coordinates in the
///   light's domain, and which are extras (emission/domain.hpp). Methods that use a photon's neighbours (second
///   order) need it; without a domain, photons are splatted one by one. Only what the lights' domains need is
///   compiled.
/// - `exact_domain() const -> EmissionDomain`, optional: the domain with kinks and edges that depend on the light's
///   options
/// - `charts() -> EmissionCharts`, or `charts_at(u1, u2, share)` for a light with area, optional: the domain without
///   kinks, piece by piece (emission/chart/). Sheets draw nothing of a light that has none, and say so
/// - `power()`: an estimate of the flux that the light sends into its domain, in the unit of `flux_traits::power`. A
///   set of lights shares its photons among them by power, so it may be zero only if the flux is zero.
///
/// ```cpp
/// struct MyLaser { // a light of the renderer's own: a beam of this radius
///     using vector = Vec3;
///     using flux_type = Colour;
///     static constexpr nephroid::EmissionDomain domain{.coordinates = 2, .kinks = {nephroid::Kinks::diagonals}};
///     Vec3 position, direction; // direction is unit
///     float radius;
///     Colour flux;
///
///     template <class Samples>
///     nephroid::Photon<Vec3, Colour> emit(Samples& samples, const nephroid::Spread<float>& spread) const {
///         const float u1 = samples.template next<float>(), u2 = samples.template next<float>();
///         const auto disk = nephroid::concentric_disk(u1, u2);
///         const nephroid::Frame<Vec3> frame = nephroid::frame_about(direction);
///         const float length = spread.length(nephroid::pi<float> * radius * radius); // the beam's section
///         const Vec3 zero(0, 0, 0);
///         return {position + radius * disk.x * frame.u + radius * disk.y * frame.v, direction,
///                 flux * (1 / spread.photons),
///                 {nephroid::Tangent<Vec3>{length * frame.u, zero}, nephroid::Tangent<Vec3>{length * frame.v, zero}}};
///     }
///     double power() const { return nephroid::flux_traits<Colour>::power(flux); }
/// };
/// ```
///
/// The compiler checks the calls; `tests/emission/light/light_laws.hpp` checks the meaning, for every model.
template <class L>
concept Light = std::copyable<L> && detail::HasVectorAndFlux<L> && detail::EmitsPhotons<L> && detail::EstimatesPower<L>;

/// The photon that a light emits.
template <class L>
using emitted_t = std::remove_cvref_t<decltype(std::declval<const L&>().emit(
    std::declval<detail::AnySampleSource&>(), std::declval<const Spread<scalar_t<typename L::vector>>&>()))>;

namespace detail {
/// The parameters of a light's photons: `NoParameters` if they have none.
template <class L>
using parameters_t = typename parameters_in<emitted_t<L>>::type;

template <class L>
concept DeclaresDomain = requires {
    { &L::domain } -> std::same_as<const EmissionDomain*>;
    requires std::bool_constant<(L::domain.coordinates == 2 || L::domain.coordinates == 4)>::value;
};

template <class L>
concept NamesDomain = requires(const L& light) {
    { light.domain } -> std::convertible_to<EmissionDomain>;
};
} // namespace detail

/// The number of coordinates of a light's domain: 2 or 4, or 0 if it declares no domain, such as a set of lights.
template <class L>
inline constexpr std::uint32_t coordinates_of = [] {
    if constexpr (detail::DeclaresDomain<L>)
        return L::domain.coordinates;
    else
        return 0u;
}();

/// A light's domain, with the kinks and edges that depend on its options.
template <class L>
    requires detail::DeclaresDomain<L>
[[nodiscard]] EmissionDomain domain_of(const L& light) {
    if constexpr (requires { light.exact_domain(); })
        return light.exact_domain();
    else
        return L::domain;
}

namespace detail {
/// The kinds of domain that a light may emit from, as known at compile time. A set of lights may have all of them.
struct EmissionDomains {
    bool two = false, four = false; ///< by the number of coordinates
    bool others = false;            ///< lights that declare no domain

    [[nodiscard]] friend constexpr EmissionDomains operator|(EmissionDomains a, EmissionDomains b) {
        return {a.two || b.two, a.four || b.four, a.others || b.others};
    }
};

/// The kinds of domain of a light, from its `domain`, or from the `domains` of a set of lights. A member with this name
/// but another type is ignored.
template <class L>
inline constexpr EmissionDomains emission_domains = [] {
    if constexpr (requires {
                      { &L::domains } -> std::same_as<const EmissionDomains*>;
                  })
        return L::domains;
    else
        return EmissionDomains{coordinates_of<L> == 2, coordinates_of<L> == 4, coordinates_of<L> == 0};
}();

template <class L>
consteval bool explain_light() {
    static_assert(HasVectorAndFlux<L>,
                  "nephroid: the light lacks its types `vector` (with vector_traits) and `flux_type` "
                  "(with flux_traits) (emission/light.hpp)");
    static_assert(EmitsPhotons<L>, "nephroid: the light lacks emit(samples, spread) const -> Photon<vector, flux_type> "
                                   "(emission/light.hpp)");
    static_assert(EstimatesPower<L>, "nephroid: the light lacks power() const -> double (emission/light.hpp)");
    static_assert(std::copyable<L>, "nephroid: a light must be copyable");
    return false;
}

template <class L>
consteval bool explain_domain() {
    static_assert(DeclaresDomain<L>, "nephroid: the light's `domain` must be a static constexpr EmissionDomain of 2 or "
                                     "4 coordinates (emission/domain.hpp)");
    return false;
}

/// A light without a domain, or with a valid one.
template <class L>
concept MustDeclareDomain = !NamesDomain<L> || DeclaresDomain<L> || explain_domain<L>();

template <class L, class V, class F>
concept EmitsFor = std::same_as<typename L::vector, V> && std::same_as<typename L::flux_type, F>;

template <class L, class V, class F>
consteval bool explain_emission() {
    static_assert(EmitsFor<L, V, F>, "nephroid: the light's `vector` and `flux_type` are not those of the sums");
    return false;
}
} // namespace detail

} // namespace nephroid
