// SPDX-License-Identifier: MIT
/// @file  How large, and of which shape, a photon's footprint should be: the rule that replaces the smoothing
///        parameter.
///
/// A photon's footprint has the covariance m₂ J S Jᵀ, S a symmetric tensor in emission coordinates whose unit is
/// u0 (S = s² 1 is the plain splat of smoothing s). With the centre shifted (second_order.hpp) the bias left is of
/// fourth order, modelled as 0.02 tr(S Q)², where Q measures by how much the map bends within a unit step in each
/// direction; the variance is 1.8/s² for random and 2.8/s⁴ for stratified photons, s⁴ = det S. For a given det S
/// the bias is least with S in proportion to Q⁻¹: wide where the map is straight, narrow where it bends, and then
/// tr(S Q) = 2 s² sqrt(det Q). That leaves a minimum over s alone.
#pragma once

#include "nephroid/smoothing/policies.hpp"
#include "nephroid/vector/plane.hpp"
#include "nephroid/vector/scalar.hpp"

#include <algorithm>
#include <cmath>

namespace nephroid::detail {

/// log Q, its eigenvalues no further apart than the stretch allows. Neighbouring cells are blended in this form.
[[nodiscard]] inline Symmetric2 log_bending(const Symmetric2& q, const SmoothingBounds& bounds) {
    const Principal2 principal(q);
    const double smaller = (std::max)(principal.smaller, principal.larger / (bounds.stretch * bounds.stretch));
    return principal.with(std::log(principal.larger), std::log(smaller));
}

/// S in proportion to Q⁻¹ with det S = s⁴, its radii within their bounds.
[[nodiscard]] inline Symmetric2 tensor_of_smoothing(const Symmetric2& log_q, double s, const SmoothingBounds& bounds) {
    const Principal2 principal(log_q);
    const double root_determinant = std::exp(0.5 * log_q.trace()); // of Q
    const auto radius2 = [&](double log_eigenvalue) {
        const double r2 = s * s * root_determinant * std::exp(-log_eigenvalue);
        return std::clamp(r2, bounds.least_radius * bounds.least_radius, bounds.largest_radius * bounds.largest_radius);
    };
    return principal.with(radius2(principal.larger), radius2(principal.smaller));
}

/// What is left of the relative bias, over s⁴: 0.02 tr(S Q)² with S in proportion to Q⁻¹.
[[nodiscard]] inline double bias_left(const Symmetric2& log_q) {
    const double root_determinant = std::exp(0.5 * log_q.trace()); // of Q
    return 0.02 * 4 * root_determinant * root_determinant;
}

/// How photons lie over the emission domain.
struct PhotonDensity {
    bool stratified = false; ///< they avoid each other (a sequence's `stratified`)
    double share = 1;        ///< of them that chance sent on this path, in (0, 1]
};

/// S from log Q.
///
/// Where a share p of the photons takes a path, each stands for 1/p times as much of the domain, and the rule holds in
/// that unit (not the bounds: wide footprints of few photons spill over edges that so few do not show). A random choice
/// among stratified photons leaves a variance of 1.8 (1 − p)/s² + 2.8 p²/s⁴.
[[nodiscard]] inline Symmetric2 smoothing_tensor(const Symmetric2& log_q, const PhotonDensity& density,
                                                 const SmoothingBounds& bounds) {
    const double p = density.share, g = bias_left(log_q) / (p * p);
    const double random = 0.923 * std::pow(g, -1.0 / 5);
    double s = random;
    if (density.stratified) {
        const double regular = 1.028 * std::pow(g, -1.0 / 6);
        s = regular;
        if (p < 1) // least: s¹² = (1 − p) random¹⁰ s² + p² regular¹²; each step leaves a sixth of the error
            for (int step = 0; step < 8; ++step)
                s = std::pow((1 - p) * std::pow(random, 10) * s * s + p * p * std::pow(regular, 12), 1.0 / 12);
    }
    return tensor_of_smoothing(log_q, (std::max)(bounds.least, s / std::sqrt(p)), bounds);
}

/// S from log Q for the photons of an area light. Two things are not as for two emission coordinates: samples of four
/// numbers are hardly stratified, so that the variance falls with 1/s² for either kind of sequence, and where the
/// slice of the map that a footprint follows has a fold, the light of all slices together is smooth and thin footprints
/// are noise alone. The 0.923 of two coordinates and random photons follows from the model of bias and variance above;
/// the 1.2 and 1.5 here do not: no such model was made for four coordinates, they were fitted to one picture
/// (ring-disk-zoom, a ring lit by a small disk) with 20,000 photons.
[[nodiscard]] inline Symmetric2 area_smoothing_tensor(const Symmetric2& log_q, bool stratified,
                                                      const SmoothingBounds& bounds) {
    const double s = (stratified ? 1.2 : 1.5) * std::pow(bias_left(log_q), -1.0 / 5);
    return tensor_of_smoothing(log_q, (std::max)(bounds.least, s), bounds);
}

/// S with its radius along a unit direction reduced to `most`, and across it as it was.
[[nodiscard]] inline Symmetric2 bounded_along(const Symmetric2& s, Plane2 direction, double most) {
    const Plane2 along = s(direction);
    const double radius2 = inner(direction, along);
    if (radius2 <= most * most)
        return s;
    Symmetric2 reduced = s;
    reduced += (-(1 - most * most / radius2) / radius2) * Symmetric2::outer(along);
    return reduced;
}

} // namespace nephroid::detail
