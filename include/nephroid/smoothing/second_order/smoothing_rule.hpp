// SPDX-License-Identifier: MIT
/// @file  The rule that chooses the size and shape of a photon's footprint from how much the map bends.
///
/// A photon's footprint has the covariance m₂ J S Jᵀ. S is a symmetric tensor in emission coordinates with the unit
/// u0; S = s² 1 is the plain splat of smoothing s. After the shift of the centre (second_order.hpp) the remaining
/// bias is of fourth order. It is modelled as 0.02 tr(S Q)², where Q measures how much the map bends within a unit
/// step in each direction. With s⁴ = det S, the variance is 1.8/s² for random and 2.8/s⁴ for stratified photons.
/// Kinks add 0.14 κ s to the squared bias, since a footprint meets them in proportion to its width and no shift
/// helps there.
///
/// For a given det S the bias is least if S is in proportion to Q⁻¹: wide where the map is straight and narrow where
/// it bends. Then tr(S Q) = 2 s² sqrt(det Q), and only s is left to minimise over [include/nephroid/README.md,
/// "Smoothing"].
#pragma once

#include "nephroid/smoothing/second_order/policies.hpp"
#include "nephroid/vector/plane.hpp"
#include "nephroid/vector/scalar.hpp"

#include <algorithm>
#include <cmath>

namespace nephroid::detail {

/// log Q, with its eigenvalues no further apart than `bounds.stretch` allows. Neighbouring cells are averaged in this
/// form.
[[nodiscard]] inline Symmetric2 log_bending(const Symmetric2& q, const SmoothingBounds& bounds) {
    const Principal2 principal(q);
    const double smaller = (std::max)(principal.smaller, principal.larger / (bounds.stretch * bounds.stretch));
    return principal.with(std::log(principal.larger), std::log(smaller));
}

/// S in proportion to Q⁻¹ with det S = s⁴, and with its radii clamped to their bounds.
[[nodiscard]] inline Symmetric2 shape_with_smoothing(const Symmetric2& log_q, double s, const SmoothingBounds& bounds) {
    const Principal2 principal(log_q);
    const double root_determinant = std::exp(0.5 * log_q.trace()); // of Q
    const auto radius2 = [&](double log_eigenvalue) {
        const double r2 = s * s * root_determinant * std::exp(-log_eigenvalue);
        return std::clamp(r2, bounds.least_radius * bounds.least_radius, bounds.largest_radius * bounds.largest_radius);
    };
    return principal.with(radius2(principal.larger), radius2(principal.smaller));
}

/// The remaining relative bias over s⁴: 0.02 tr(S Q)² with S in proportion to Q⁻¹.
[[nodiscard]] inline double remaining_bias(const Symmetric2& log_q) {
    const double root_determinant = std::exp(0.5 * log_q.trace()); // of Q
    return 0.02 * 4 * root_determinant * root_determinant;
}

/// How photons are distributed over the emission domain.
struct PhotonDensity {
    bool stratified = false; ///< whether they keep apart (a sequence's `stratified`)
    double share = 1;        ///< of them that took this path, in (0, 1]
};

/// The s at which the squared error is least: stratified/s⁴ + random/s² + g² s⁸ + k s.
///
/// @param stratified, random  parts of the variance, >= 0 and not both 0
/// @param g                   bias over s⁴, > 0 (`remaining_bias`)
/// @param k                   squared bias over s, >= 0
[[nodiscard]] inline double best_smoothing(double stratified, double random, double g, double k) {
    // Without kinks and with either variance alone s¹² is stratified/(2 g²), and s¹⁰ random/(4 g²).
    const double g2 = g * g;
    double s = (std::max)(std::pow(stratified / (2 * g2), 1.0 / 12), std::pow(random / (4 * g2), 1.0 / 10));
    // At the minimum `grows` equals `falls`: Newton's method in log s for log(grows / falls), whose slope is 3 to 12.
    for (int step = 0; step < 8; ++step) {
        const double s2 = s * s, s4 = s2 * s2;
        const double bend = 8 * g2 * s4 * s4, kink = k * s, grows = bend + kink;
        const double kept_apart = 4 * stratified / s4, chance = 2 * random / s2, falls = kept_apart + chance;
        const double slope = (8 * bend + kink) / grows + (4 * kept_apart + 2 * chance) / falls;
        s *= std::pow(falls / grows, 1 / slope);
    }
    return s;
}

/// S from log Q.
///
/// Where a share p of the photons takes a path, each stands for 1/p times as much of the domain. The rule is applied in
/// that unit, u0/√p. The bounds stay in u0, because wide footprints of few photons would spill over edges. If chance
/// selects a share of stratified photons, the variance is 1.8 (1 − p)/s² + 2.8 p²/s⁴.
///
/// @param kinks  κ, squared jumps per u0 (`MapKinks::density`)
[[nodiscard]] inline Symmetric2 shape_tensor(const Symmetric2& log_q, const PhotonDensity& density,
                                             const SmoothingBounds& bounds, double kinks = 0) {
    constexpr double random = 1.8, stratified = 2.8, kink = 0.14;
    const double p = density.share, g = remaining_bias(log_q) / (p * p), k = kink * kinks / std::sqrt(p);
    const double s = density.stratified ? best_smoothing(stratified * p * p, random * (1 - p), g, k)
                                        : best_smoothing(0, random, g, k);
    return shape_with_smoothing(log_q, (std::max)(bounds.least, s / std::sqrt(p)), bounds);
}

/// S from log Q for the photons of an area light. It differs from two emission coordinates in two ways. Samples of four
/// coordinates are hardly stratified, so that the variance falls with 1/s² for both kinds of sequence. And where the
/// slice of the map that a footprint follows has a fold, the light of all slices together is smooth, and thin
/// footprints only show noise. The factor 0.923 of two coordinates and random photons follows from the model of bias
/// and variance above. The factors 1.2 and 1.5 do not follow from a model: they were fitted to one picture
/// (ring-disk-zoom, a ring lit by a small disk) with 20,000 photons.
[[nodiscard]] inline Symmetric2 area_shape_tensor(const Symmetric2& log_q, bool stratified,
                                                  const SmoothingBounds& bounds) {
    const double s = (stratified ? 1.2 : 1.5) * std::pow(remaining_bias(log_q), -1.0 / 5);
    return shape_with_smoothing(log_q, (std::max)(bounds.least, s), bounds);
}

/// S with its radius along a unit direction reduced to a limit, and unchanged across it.
[[nodiscard]] inline Symmetric2 bounded_along(const Symmetric2& s, Plane2 direction, double limit) {
    const Plane2 along = s(direction);
    const double radius2 = inner(direction, along);
    if (radius2 <= limit * limit)
        return s;
    Symmetric2 reduced = s;
    reduced += (-(1 - limit * limit / radius2) / radius2) * Symmetric2::outer(along);
    return reduced;
}

} // namespace nephroid::detail
