// SPDX-License-Identifier: MIT
/// @file  What a surface does with a photon.
#pragma once

#include "nephroid/emission/flux.hpp"

namespace nephroid {

enum class Event : unsigned char {
    absorb,  ///< the photon ends
    reflect, ///< mirror reflection
    refract, ///< into the other medium; beyond the critical angle the walk reflects instead
    deposit, ///< the surface is diffuse (or glossy): the photon is splatted here and ends
    pass,    ///< a false surface, such as one between two bodies of water: the photon goes on as it is, into `medium`
};

/// Normals are best left pointing out of the object, as the surface has them. A tracer that turns them to face every
/// ray knows from its own "front face" whether the ray enters: dot(direction, normal) < 0 is then true on the way out
/// too.
///
/// The answer of a scene's `scatter`. Your own type with these members will do as well; `eta` is only read for
/// Event::refract, and a type may have a further member `medium` (the one that a refracted ray enters, for scenes
/// with absorption) and `d_eta` (std::array, ∂η of each tangent, for a wavelength tangent). A type of a scene
/// without glass does without `eta` and says so: `static constexpr bool refracts = false`. Then no refraction is
/// compiled.
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
    F weight = flux_traits<F>::zero(); ///< the flux is multiplied by this: reflectance over the event's probability
    T eta = T(1);                      ///< n₁/n₂, the index on the ray's side over that on the other side

    [[nodiscard]] static Scattering absorb() { return {}; }
    [[nodiscard]] static Scattering deposit() { return {Event::deposit, flux_traits<F>::zero(), T(1)}; }
    [[nodiscard]] static Scattering reflect(const F& weight) { return {Event::reflect, weight, T(1)}; }
    [[nodiscard]] static Scattering refract(const F& weight, T eta) { return {Event::refract, weight, eta}; }
};

/// The answer of a scene of mirrors.
template <Flux F>
struct MirrorScattering {
    static constexpr bool refracts = false;

    Event event = Event::absorb;
    F weight = flux_traits<F>::zero(); ///< the flux is multiplied by this

    [[nodiscard]] static MirrorScattering absorb() { return {}; }
    [[nodiscard]] static MirrorScattering deposit() { return {Event::deposit, flux_traits<F>::zero()}; }
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
