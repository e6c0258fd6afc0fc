// SPDX-License-Identifier: MIT
/// @file  A photon that has been followed to where it is splatted, with its parameters, and its splats.
#pragma once

#include "nephroid/emission/without_tangents.hpp"
#include "nephroid/splat/spectral_splat.hpp"
#include "nephroid/splat/splatter.hpp"
#include "nephroid/transport/parametric_scene.hpp"
#include "nephroid/transport/walk.hpp"

#include <cstddef>
#include <optional>
#include <type_traits>
#include <utility>

namespace nephroid::detail {

/// A photon's deposit, if it has one, and what a splat needs to know of the photon besides.
template <class L>
struct LandedPhoton {
    std::optional<Deposit<typename L::vector, typename L::flux_type, tangent_count_of<L>>> deposit{};
    [[no_unique_address]] parameters_t<L> parameters{};
};

/// Emits a photon and follows it.
template <class S, PhotonSource L, class Sampler>
[[nodiscard]] LandedPhoton<L> land(const S& scene, const L& light, Sampler& sampler,
                                   const Spread<scalar_t<typename L::vector>>& spread, const WalkLimits& limits,
                                   Statistics& account) {
    if constexpr (std::is_same_v<parameters_t<L>, NoParameters>) {
        return {walk(scene, light.emit(sampler, spread), sampler, limits, account), {}};
    } else {
        auto photon = light.emit(sampler, spread);
        auto deposit = walk(scene, std::move(photon), sampler, limits, account);
        return {std::move(deposit), photon.parameters};
    }
}

/// Makes the splats of a deposit, one or several as its parameters ask for, and books them.
template <class Splatter, Vector3 V, Flux F, std::size_t N, class P>
void prepare_splats(const Splatter& splatter, const Deposit<V, F, N>& deposit, const P& parameters,
                    typename Splatter::Chunk& chunk, Statistics& account) {
    if constexpr (has_wavelength<P>)
        prepare_bands(splatter, deposit, parameters, chunk, account);
    else
        splatter.prepare(deposit, chunk, account);
}

/// A light's scene: as its photons see it.
template <class S, class L>
struct scene_seen_by {
    using type = ParametricScene<S, parameters_t<L>>;
};
template <class S, class L>
    requires std::is_same_v<parameters_t<L>, NoParameters>
struct scene_seen_by<S, L> {
    using type = S;
};
template <class S, class L>
using scene_for = typename scene_seen_by<S, L>::type;

} // namespace nephroid::detail
