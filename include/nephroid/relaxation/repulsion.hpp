// SPDX-License-Identifier: MIT
/// @file  The force between photons, and how far a photon follows it: eq. 1 to 3, 10 and 11 of Spencer and Jones 2009,
///        "Into the Blue: Better Caustics through Photon Relaxation".
#pragma once

#include "nephroid/relaxation/photon_constraint.hpp"
#include "nephroid/vector/algebra.hpp"

#include <cmath>
#include <limits>

namespace nephroid::detail {

/// τ(i), the over-relaxation of an iteration [eq. 2].
///
/// @param iteration  i, from 0
/// @param iterations I, > 0
[[nodiscard]] inline double over_relaxation(unsigned iteration, unsigned iterations, double lambda_max,
                                            double lambda_min) {
    const double progress = double(iteration) / iterations;
    return lambda_min + (lambda_max - lambda_min) * std::exp(-6 * progress * progress);
}

/// The fraction of its force that a photon follows: from 1 at the first iteration to `final_step` at the last, in equal
/// steps. Ours, for over-relaxed photons, which do not come to rest.
[[nodiscard]] inline double step_fraction(unsigned iteration, unsigned iterations, double final_step) {
    return iterations > 1 ? 1 - (1 - final_step) * iteration / (iterations - 1) : 1;
}

/// The force that one neighbour exerts on a photon [the summand of eq. 1].
///
/// @param offset    x − x_k, from the neighbour to the photon
/// @param distance  its length
/// @param reach     r τ(i): where repulsion turns into attraction; > 0
/// Neighbours in the same place have no direction and exert nothing.
template <Vector3 V>
[[nodiscard]] V repulsion(const V& offset, scalar_t<V> distance, scalar_t<V> reach) {
    using T = scalar_t<V>;
    const T nothing = reach * std::numeric_limits<T>::epsilon(); // the paper's ε: no number is divided by zero
    return (reach / (distance + nothing) - distance / reach) * offset;
}

/// A force without its part along the unit normal [eq. 3]. The paper's basis u, v, of which u = n × (−n_x, n_y,
/// −n_z) vanishes for n_y = 0, spans this plane where it spans any.
template <Vector3 V>
[[nodiscard]] V in_tangent_plane(const V& force, const V& normal) {
    return force - dot(force, normal) * normal;
}

/// A force in the tangent plane, of which the fraction w across the feature is taken away [eq. 10].
///
/// Where the direction is zero (features that cancel out) the photon is held back in all directions.
template <Vector3 V>
[[nodiscard]] V constrained(const V& force, const PhotonConstraint<V>& constraint) {
    using T = scalar_t<V>;
    // (v · f) v + (g · f) g is the force: what remains across is (1 − w) of it.
    const V along = dot(force, constraint.direction) * constraint.direction;
    return along + (T(1) - constraint.weight) * (force - along);
}

/// The factor exp(−(|f|/r)² ln 2/ρ²) on a move: half at |f| = ρ r [eq. 11, as its text describes it].
///
/// @param move2    |f|²
/// @param radius2  r², of the disc of K + 1 neighbours; > 0
/// @param rho      > 0
template <Scalar T>
[[nodiscard]] T diffusion_limit(T move2, T radius2, T rho) {
    using std::exp;
    constexpr double ln2 = 0.69314718055994530942;
    return exp(-(move2 / radius2) * (T(ln2) / (rho * rho)));
}

} // namespace nephroid::detail
