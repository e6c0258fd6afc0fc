// SPDX-License-Identifier: MIT
/// @file  What a surface does with a photon.
#pragma once

#include "nephroid/emission/flux.hpp"

namespace nephroid {

/// What happens to a photon at a surface: `Scattering::event`.
enum class Event : unsigned char {
    absorb,  ///< the photon ends
    reflect, ///< mirror reflection
    refract, ///< into the other medium; beyond the critical angle the walk reflects instead
    deposit, ///< the surface is diffuse (or glossy): the photon is deposited, and ends unless a visitor sends it on
    pass,    ///< light does not notice this surface, such as one inside of water: the photon goes on, into `medium`
    diffuse, ///< as deposit, and the surface scatters the share `weight`, its albedo in [0, 1], in all directions.
             ///< Where light between diffuse surfaces is not asked for, the photon ends
};

/// The result of a scene's `scatter`. Your own type with these members will do as well. `eta` is only read for
/// Event::refract. A weight that is negative or not finite in a band, and an `eta` that is not positive and finite, end
/// the photon as Fate::invalid. A type may also have the members `medium` (which a refracted ray enters, for scenes
/// with absorption) and `d_eta` (∂η/∂λ, for the wavelength tangents of photons that have a wavelength; or a
/// std::array with the ∂η of each tangent, for any photon). In a scene without glass
/// the type may leave out `eta` and declare `static constexpr bool refracts = false`; then no refraction is compiled.
///
/// Whether a ray enters an object is best seen from normals that point out of it: dot(direction, normal) < 0. In a
/// renderer whose normals always face the ray this is always true; use its own "front face" flag instead.
///
/// ```cpp
/// // Glass that reflects or refracts by chance, each with its Fresnel term over its probability: both weights are 1.
/// const float reflectance = fresnel(hit, direction);
/// if (random.template next<float>() < reflectance)
///     return Scattering::reflect(1);
/// return Scattering::refract(1, entering ? 1 / index : index);
/// ```
template <Flux F, Scalar T>
struct Scattering {
    Event event = Event::absorb;
    F weight = flux_traits<F>::zero(); ///< the flux is multiplied by this: reflectance over the event's probability. Of
                                       ///< Event::diffuse it is the albedo, of Event::deposit nothing
    T eta = T(1);                      ///< n₁/n₂, the index on the ray's side over that on the other side

    [[nodiscard]] static Scattering absorb() { return {}; }
    [[nodiscard]] static Scattering deposit() { return {Event::deposit, flux_traits<F>::zero(), T(1)}; }
    [[nodiscard]] static Scattering diffuse(const F& albedo) { return {Event::diffuse, albedo, T(1)}; }
    [[nodiscard]] static Scattering reflect(const F& weight) { return {Event::reflect, weight, T(1)}; }
    [[nodiscard]] static Scattering refract(const F& weight, T eta) { return {Event::refract, weight, eta}; }
};

/// The result of `scatter` in a scene of mirrors.
template <Flux F>
struct MirrorScattering {
    static constexpr bool refracts = false;

    Event event = Event::absorb;
    F weight = flux_traits<F>::zero(); ///< the flux is multiplied by this

    [[nodiscard]] static MirrorScattering absorb() { return {}; }
    [[nodiscard]] static MirrorScattering deposit() { return {Event::deposit, flux_traits<F>::zero()}; }
    [[nodiscard]] static MirrorScattering diffuse(const F& albedo) { return {Event::diffuse, albedo}; }
    [[nodiscard]] static MirrorScattering reflect(const F& weight) { return {Event::reflect, weight}; }
};

namespace detail {
template <class Scattering>
inline constexpr bool refracts = [] {
    if constexpr (requires { Scattering::refracts; })
        return bool(Scattering::refracts);
    else
        return true;
}();
} // namespace detail

} // namespace nephroid
