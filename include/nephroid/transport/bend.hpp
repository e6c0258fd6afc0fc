// SPDX-License-Identifier: MIT
/// @file  How a mirror or glass turns a photon and its tangents.
#pragma once

#include "nephroid/differential/reflection.hpp"
#include "nephroid/differential/refraction.hpp"
#include "nephroid/differential/tangent.hpp"
#include "nephroid/emission/photon.hpp"
#include "nephroid/transport/scattering.hpp"

#include <cstddef>

namespace nephroid::detail {

/// +1 or −1: what turns a hit's normals, and the change of the shading one, to face a photon of this direction.
template <Vector3 V, class H>
[[nodiscard]] scalar_t<V> facing_sign(const V& direction, const H& hit) {
    using T = scalar_t<V>;
    return dot(direction, V(hit.geometric_normal)) > T(0) ? T(-1) : T(1);
}

/// Sends a photon the way that its direction turned.
///
/// @param turn    a Reflection or a Refraction
/// @param normal  that it turned about, facing the photon
template <Vector3 V, Flux F, std::size_t N, class Turn, class H, class Scattering>
void follow_turn(Photon<V, F, N>& photon, const Turn& turn, const V& normal, const H& hit,
                 const Scattering& scattering) {
    using T = scalar_t<V>;
    if constexpr (N > 0) {
        const T side = facing_sign(photon.direction, hit);
        for (std::size_t i = 0; i < N; ++i) {
            Tangent<V>& tangent = photon.differential[i];
            const V d_shading = side * V(hit.curvature(tangent.d_position));
            // The normal in use may be the geometric one.
            const V d_normal = d_shading - dot(normal, d_shading) * normal;
            if constexpr (requires { turn.differentiate(d_normal, d_normal, T(scattering.d_eta[i])); })
                tangent.d_direction = turn.differentiate(tangent.d_direction, d_normal, T(scattering.d_eta[i]));
            else
                tangent.d_direction = turn.differentiate(tangent.d_direction, d_normal);
            bring_into_range(tangent);
        }
    }
    photon.direction = turn.direction();
}

/// Reflects or refracts a photon about a normal that faces it; a refraction changes the medium.
///
/// @return  false, and nothing is changed, where the photon would leave to the wrong side of the surface
template <Vector3 V, Flux F, std::size_t N, class Medium, class H, class Scattering>
[[nodiscard]] bool bend_about(Photon<V, F, N>& photon, [[maybe_unused]] Medium& medium, const V& normal,
                              const V& geometric_normal, const H& hit, const Scattering& scattering) {
    using T = scalar_t<V>;
    if (scattering.event == Event::refract) {
        if constexpr (!refracts<Scattering>) {
            return false; // it said that it never would
        } else if (const auto refracted = refraction(photon.direction, normal, T(scattering.eta))) {
            if (!(dot(refracted->direction(), geometric_normal) < T(0)))
                return false;
            follow_turn(photon, *refracted, normal, hit, scattering);
            if constexpr (requires { medium = scattering.medium; })
                medium = scattering.medium;
            return true;
        }
    }
    const Reflection<V> reflected(photon.direction, normal);
    if (!(dot(photon.direction, normal) < T(0)) || !(dot(reflected.direction(), geometric_normal) > T(0)))
        return false;
    follow_turn(photon, reflected, normal, hit, scattering);
    return true;
}

} // namespace nephroid::detail
