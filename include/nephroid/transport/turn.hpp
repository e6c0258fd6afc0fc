// SPDX-License-Identifier: MIT
/// @file  Turns a photon and its tangents at a mirror or glass.
#pragma once

#include "nephroid/differential/reflection.hpp"
#include "nephroid/differential/refraction.hpp"
#include "nephroid/differential/tangent.hpp"
#include "nephroid/emission/photon.hpp"
#include "nephroid/transport/scattering.hpp"

#include <cstddef>

namespace nephroid::detail {

/// The factor, +1 or −1, that makes a hit's normals face a photon of this direction. The change of the shading normal
/// gets the same factor.
template <Vector3 V, class H>
[[nodiscard]] scalar_t<V> facing_sign(const V& direction, const H& hit) {
    using T = scalar_t<V>;
    return dot(direction, V(hit.geometric_normal)) > T(0) ? T(-1) : T(1);
}

/// The change of the normal about which a photon turns, along a tangent.
///
/// @param sign    of the hit's normals, `facing_sign`
/// @param normal  about which the photon turns. It may be the geometric one, so only the shading normal's change across
///                it counts
template <Vector3 V, class H>
[[nodiscard]] V change_of_normal(const Tangent<V>& tangent, scalar_t<V> sign, const V& normal, const H& hit) {
    const V d_shading = sign * V(hit.curvature(tangent.d_position));
    return d_shading - dot(normal, d_shading) * normal;
}

/// The scattering has one ∂η, for those of N tangents whose parameter changes it
/// (transport/parametric_scattering.hpp).
template <class Scattering, class Turn, class T, std::size_t N>
concept ChangesIndexByKind = requires(const Scattering& scattering, const Turn& turn) {
    scattering.template changes_index<N>(std::size_t(0));
    turn.differentiate(turn.direction(), turn.direction(), T(scattering.d_eta));
};

/// Gives a photon the direction and the tangents after a turn.
///
/// @param turn    a Reflection or a Refraction
/// @param normal  about which the photon turns; faces the photon
template <Vector3 V, Flux F, std::size_t N, class Turn, class H, class Scattering>
void apply_turn(Photon<V, F, N>& photon, const Turn& turn, const V& normal, const H& hit,
                const Scattering& scattering) {
    using T = scalar_t<V>;
    if constexpr (N > 0) {
        const T sign = facing_sign(photon.direction, hit);
        for (std::size_t i = 0; i < N; ++i) {
            Tangent<V>& tangent = photon.differential[i];
            const V d_normal = change_of_normal(tangent, sign, normal, hit);
            if constexpr (requires { turn.differentiate(d_normal, d_normal, T(scattering.d_eta[i])); })
                tangent.d_direction = turn.differentiate(tangent.d_direction, d_normal, T(scattering.d_eta[i]));
            else if constexpr (ChangesIndexByKind<Scattering, Turn, T, N>)
                tangent.d_direction = scattering.template changes_index<N>(i)
                                          ? turn.differentiate(tangent.d_direction, d_normal, T(scattering.d_eta))
                                          : turn.differentiate(tangent.d_direction, d_normal);
            else
                tangent.d_direction = turn.differentiate(tangent.d_direction, d_normal);
            bring_into_range(tangent);
        }
    }
    photon.direction = turn.direction();
}

/// Tells a photon's parameters of glass, if it has any (transport/parametric_scattering.hpp).
template <Vector3 V, Flux F, std::size_t N, class H, class Scattering>
void note_glass([[maybe_unused]] const Photon<V, F, N>& photon, [[maybe_unused]] const V& normal,
                [[maybe_unused]] const H& hit, [[maybe_unused]] const Scattering& scattering) {
    if constexpr (requires { scattering.template changes_index<N>(std::size_t(0)); })
        scattering.note_glass(photon, normal, [&](const Tangent<V>& tangent) {
            return change_of_normal(tangent, facing_sign(photon.direction, hit), normal, hit);
        });
}

/// Whether a reflection names the indices on both sides of the surface.
template <class T, class Scattering>
[[nodiscard]] constexpr bool is_off_glass([[maybe_unused]] const Scattering& scattering) {
    if constexpr (requires { T(scattering.eta); })
        return scattering.event == Event::reflect && T(scattering.eta) != T(1);
    else
        return false;
}

/// Reflects or refracts a photon about a normal that faces it; a refraction changes the medium.
///
/// @return  false, with nothing changed, if the photon would leave on the wrong side of the surface
template <Vector3 V, Flux F, std::size_t N, class Medium, class H, class Scattering>
[[nodiscard]] bool turn_about(Photon<V, F, N>& photon, [[maybe_unused]] Medium& medium, const V& normal,
                              const V& geometric_normal, const H& hit, const Scattering& scattering) {
    using T = scalar_t<V>;
    if (scattering.event == Event::refract) {
        if constexpr (!refracts<Scattering>) {
            return false; // the type says that its scene has no glass
        } else if (const auto refracted = refraction(photon.direction, normal, T(scattering.eta))) {
            if (!(dot(refracted->direction(), geometric_normal) < T(0)))
                return false;
            note_glass(photon, normal, hit, scattering);
            apply_turn(photon, *refracted, normal, hit, scattering);
            if constexpr (requires { medium = scattering.medium; })
                medium = scattering.medium;
            return true;
        }
    }
    const Reflection<V> reflected(photon.direction, normal);
    if (!(dot(photon.direction, normal) < T(0)) || !(dot(reflected.direction(), geometric_normal) > T(0)))
        return false;
    if (scattering.event == Event::refract || is_off_glass<T>(scattering))
        note_glass(photon, normal, hit, scattering);
    apply_turn(photon, reflected, normal, hit, scattering);
    return true;
}

} // namespace nephroid::detail
