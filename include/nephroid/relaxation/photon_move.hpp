// SPDX-License-Identifier: MIT
/// @file  Where its neighbours push one photon.
#pragma once

#include "nephroid/relaxation/neighbourhood.hpp"
#include "nephroid/relaxation/photon_constraint.hpp"
#include "nephroid/relaxation/repulsion.hpp"
#include "nephroid/relaxation/separation.hpp"

#include <algorithm>
#include <span>

namespace nephroid::detail {

/// A photon and the neighbours that push it.
template <class Cloud>
struct Push {
    using T = typename Cloud::T;
    std::size_t slot;
    std::span<const Neighbour<T>> neighbours; ///< nearest first; the last one gives the radius and does not push
    T radius;                                 ///< r of eq. 1, > 0
    T limit_radius; ///< r_p of eq. 11, > 0: the radius of the iteration before, which avoids artefacts
    bool heap;      ///< all neighbours lie where the photon does; no constraint holds it, or it would stay for ever
};

/// The force on a photon [eq. 1 and 3], constrained and damped [eq. 10 and 11].
///
/// @param around      the photons around, where they are by now
/// @param relaxation  τ of eq. 2
/// @param constraint  of the photon, or null
/// @param rho         of eq. 11; 0 damps nothing
template <class Cloud, Scalar T>
[[nodiscard]] typename Cloud::vector move_of(const Cloud& cloud, const Neighbourhood<Cloud>& around,
                                             const Push<Cloud>& push, T relaxation,
                                             const PhotonConstraint<typename Cloud::vector>* constraint, T rho) {
    using V = typename Cloud::vector;
    const std::size_t slot = push.slot, pushing = push.neighbours.size() - 1;
    const V position = cloud.position(slot);
    const T reach = push.radius * relaxation;
    V force = zero_vector<V>();
    for (std::size_t k = 0; k < pushing; ++k) {
        const auto [distance2, other] = push.neighbours[k];
        force =
            force + (distance2 > T(0) ? repulsion<V>(position - around.position(cloud, other), sqrt(distance2), reach)
                                      : reach * separation_direction(cloud, slot, other));
    }
    force = in_tangent_plane<V>(T(1) / T(pushing) * force, cloud.normal(slot));
    const T longest = T(0.25) * push.radius;
    if (push.heap) // shortened, as damping would all but stop so strong a force
        force = (longest / (std::max)(longest, T(length(force)))) * force;
    else if (constraint != nullptr &&
             push.neighbours.front().distance2 > T(0)) // photons in one place part on edges too
        force = constrained(force, *constraint);
    if (rho > T(0))
        force = diffusion_limit<T>(length2(force), square(push.limit_radius), rho) * force;
    return force;
}

} // namespace nephroid::detail
