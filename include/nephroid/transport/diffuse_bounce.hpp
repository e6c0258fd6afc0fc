// SPDX-License-Identifier: MIT
/// @file  A diffuse surface sends a photon on: in a random direction, with the albedo as the probability that it does.
#pragma once

#include "nephroid/emission/warp.hpp"
#include "nephroid/transport/photon_steps.hpp"
#include "nephroid/transport/value_checks.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace nephroid::detail {

/// Notes an albedo that cannot be, and the surface that has it, if it is the first one.
template <class H>
void note_invalid_albedo(const H& hit, double albedo, Statistics& account) {
    if (account.invalid_albedos++ > 0)
        return;
    account.invalid_albedo = albedo;
    if constexpr (requires { std::uint64_t(hit.surface); })
        account.invalid_albedo_surface = std::uint64_t(hit.surface);
}

/// A direction above a diffuse surface with density cos/π about the shading normal. If it would lead into the surface,
/// the same two numbers choose one about the geometric normal instead, and the account counts it.
///
/// @param incoming  the direction of flight to the surface, unit
template <Vector3 V, class H, class Sampler>
[[nodiscard]] V diffuse_direction(const V& incoming, const H& hit, Sampler& sampler, Statistics& account) {
    using T = scalar_t<V>;
    const T sign = facing_sign(incoming, hit), u1 = sampler.template next<T>(), u2 = sampler.template next<T>();
    const V geometric_normal = sign * V(hit.geometric_normal);
    const DiskPoint<T> disk = concentric_disk(u1, u2);
    if constexpr (HasShadingNormal<H, V>) {
        const V shading_normal = sign * V(hit.shading_normal);
        const V direction = cosine_direction(shading_normal, frame_about(shading_normal), disk);
        if (dot(direction, geometric_normal) > T(0))
            return direction;
        ++account.corrected_normals;
    }
    return cosine_direction(geometric_normal, frame_about(geometric_normal), disk);
}

/// The density per steradian of a direction that `diffuse_direction` chose: cos/π.
template <Vector3 V, class H>
[[nodiscard]] scalar_t<V> diffuse_density(const V& direction, const H& hit) {
    using T = scalar_t<V>;
    if constexpr (HasShadingNormal<H, V>) // the sides of both normals are unknown here, but not that it leads away
        if (const T cosine = abs(dot(direction, V(hit.shading_normal))); cosine > T(0))
            return cosine / pi<T>;
    return abs(dot(direction, V(hit.geometric_normal))) / pi<T>;
}

/// Scatters a photon at a diffuse surface. It survives with a probability of the power that the albedo leaves over the
/// power that arrived, and then carries the latter; otherwise it is absorbed with all of it. So the photons after a
/// bounce are as bright as before, and fewer.
///
/// @param albedo  the share that the surface scatters, in [0, 1] in each band: else the photon is invalid. A flux, or
///                what a flux can be multiplied by, as the weights of reflections
/// @return  whether the photon goes on; its position stays that of the hit, and its tangents are left as they were
template <class S, Vector3 V, Flux F, std::size_t N, class H, class Albedo, class Sampler>
[[nodiscard]] bool bounce_diffusely(PhotonSteps<S, V, F, N>& steps, const H& hit, const Albedo& albedo,
                                    Sampler& sampler, Statistics& account) {
    using T = scalar_t<V>;
    constexpr double most = 1.001; // more than that is no rounding
    Photon<V, F, N> photon = steps.photon();
    const double arrived = steps.power(photon.flux);
    if (!(arrived > 0)) // from a black mirror, and no albedo is a share of nothing
        return steps.end(arrived == 0 ? Fate::absorbed : Fate::invalid);
    const auto scattered = static_cast<F>(photon.flux * albedo);
    const double survival = steps.power(scattered) / arrived;
    if (!isfinite(survival) || has_negative_band(scattered) || has_band_above(scattered, photon.flux, most)) {
        note_invalid_albedo(hit, survival, account);
        return steps.end(Fate::invalid);
    }
    if constexpr (HasShadingNormal<H, V>)
        if (!is_unit(V(hit.shading_normal))) // no direction about it would be unit, or have the density cos/π
            return steps.end(Fate::invalid);
    if (!(sampler.template next<double>() < survival))
        return steps.end(Fate::absorbed);
    photon.direction = diffuse_direction(photon.direction, hit, sampler, account);
    photon.flux = scattered * T(1 / survival);
    if (!isfinite(steps.power(photon.flux)))
        return steps.end(Fate::invalid);
    account.lose(Fate::absorbed, arrived - steps.power(photon.flux)); // a rounding
    ++account.diffuse_bounces;
    steps.continue_as(photon, steps.medium());
    return true;
}

} // namespace nephroid::detail
