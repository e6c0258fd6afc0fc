// SPDX-License-Identifier: MIT
/// @file  What a photon may have besides its ray and its flux, such as a wavelength, and what its tangents are taken
///        by.
#pragma once

#include "nephroid/emission/photon.hpp"

#include <array>
#include <concepts>
#include <cstddef>
#include <type_traits>

namespace nephroid {

/// The parameter by which a tangent is the derivative.
enum class TangentKind : unsigned char {
    footprint,  ///< a coordinate of the emission domain: its length says how far apart photons are
    extent,     ///< the size of what the photon stands for besides, such as a sun's disk; smoothing does not scale it
    wavelength, ///< the photon's wavelength: ∂η is asked of the scene for this kind alone
    time,       ///< the time at which the photon flies
};

/// The parameters of photons that have none.
struct NoParameters {
    static constexpr std::array<TangentKind, 0> tangents{};
};

/// A photon with parameters, which a scene's functions get as a last argument if they take one
/// (transport/parametric_scene.hpp).
///
/// @tparam P  a small value type. `P::tangents`, an array of TangentKind, says of which kinds the photon's last
///            tangents are; those before them are footprint tangents
template <Vector3 V, Flux F, std::size_t N, class P>
struct ParametricPhoton {
    using vector = V;
    using flux_type = F;
    using parameters_type = P;
    static constexpr std::size_t tangent_count = N;

    V position;                            ///< as in `Photon`, and so are the next three
    V direction;                           ///< unit
    F flux;                                ///< of this photon alone
    PhotonDifferential<V, N> differential; ///< its last tangents are by the parameters
    P parameters;
};

/// The kinds of a photon's tangents.
template <std::size_t N, class P>
    requires(P::tangents.size() <= N)
inline constexpr std::array<TangentKind, N> tangent_kinds = [] {
    std::array<TangentKind, N> kinds{};
    constexpr std::size_t first = N - P::tangents.size();
    for (std::size_t i = first; i < N; ++i)
        kinds[i] = P::tangents[i - first];
    return kinds;
}();

namespace detail {
template <class Photon>
struct parameters_in {
    using type = NoParameters;
};
template <class Photon>
    requires requires { typename Photon::parameters_type; }
struct parameters_in<Photon> {
    using type = typename Photon::parameters_type;
};

/// The parameters of a photon: `NoParameters` for a plain one.
template <class Photon>
[[nodiscard]] constexpr typename parameters_in<Photon>::type parameters_of([[maybe_unused]] const Photon& photon) {
    if constexpr (requires { photon.parameters; })
        return photon.parameters;
    else
        return {};
}

/// The photon without its parameters.
template <Vector3 V, Flux F, std::size_t N, class P>
[[nodiscard]] Photon<V, F, N> plain(const ParametricPhoton<V, F, N, P>& photon) {
    return {photon.position, photon.direction, photon.flux, photon.differential};
}
template <Vector3 V, Flux F, std::size_t N>
[[nodiscard]] const Photon<V, F, N>& plain(const Photon<V, F, N>& photon) {
    return photon;
}

template <class P>
inline constexpr bool has_wavelength = [] {
    for (const TangentKind kind : P::tangents)
        if (kind == TangentKind::wavelength)
            return true;
    return false;
}();
} // namespace detail

} // namespace nephroid
