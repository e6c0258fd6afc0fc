// SPDX-License-Identifier: MIT
/// @file  Chooses one smoothing for all photons of a pass by cross-validation, if nothing is known about the light.
///
/// Let W be the picture from all photons at one smoothing, A and B the pictures from its two halves, and A₀ and B₀
/// those from the halves at a small smoothing. The sum over the vertices of W² − A B₀ − B A₀ is on average the
/// squared error of W plus a constant, except for the correlation between the halves of a sequence.
/// include/nephroid/README.md, "Cross-validation", derives this, and how s grows with the number of photons.
#pragma once

#include "nephroid/execution/executor.hpp"
#include "nephroid/pass/photon_pass.hpp"
#include "nephroid/smoothing/quarter_pictures.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace nephroid::detail {

/// The order β with which the variance of an estimate falls with the number n of its photons, as n^−β: 1 for random
/// photons, up to 2 for photons that keep apart.
[[nodiscard]] inline double noise_order(const QuarterPictures& q) {
    double quarters = 0, halves = 0;
    for (std::size_t i = 0; i < q[0].size(); ++i) {
        quarters += 0.5 * (square(q[0][i] - q[1][i]) + square(q[2][i] - q[3][i]));
        halves += 0.25 * square((q[0][i] + q[1][i]) - (q[2][i] + q[3][i]));
    }
    return halves > 0 ? std::clamp(std::log2(quarters / halves), 1.0, 2.0) : 1;
}

/// The squared error of the picture from all quarters together, summed over the vertices, plus a constant.
///
/// @param sharp  pictures of the same quarters at a small smoothing
/// @param order  from noise_order
[[nodiscard]] inline double validated_error(const QuarterPictures& q, const QuarterPictures& sharp, double order) {
    const double correlation = std::exp2(1 - order) - 1;
    double error = 0, difference = 0;
    for (std::size_t i = 0; i < q[0].size(); ++i) {
        const double a = 0.5 * (q[0][i] + q[1][i]), b = 0.5 * (q[2][i] + q[3][i]);
        const double a0 = 0.5 * (sharp[0][i] + sharp[1][i]), b0 = 0.5 * (sharp[2][i] + sharp[3][i]);
        error += square(0.5 * (a + b)) - a * b0 - b * a0 + a0 * b0; // the last is a constant that keeps the sum small
        difference += (a - b) * (a0 - b0);
    }
    return error + correlation / (1 - correlation) * difference;
}

/// The step at which an error is least, as a real number: the minimum of the parabola through three steps. Steps are
/// tried from 0 on, until two in a row were worse.
///
/// @param error_at    error_at(step) for a whole step
/// @param most_steps  >= 2
/// @return  nothing if the error does not depend on the step, or is no number
template <class ErrorAt>
[[nodiscard]] std::optional<double> best_step(const ErrorAt& error_at, std::size_t most_steps) {
    std::vector<double> error;
    std::size_t best = 0;
    for (std::size_t step = 0; step < most_steps && step <= best + 2; ++step) {
        error.push_back(error_at(step));
        if (error[step] < error[best])
            best = step;
    }
    if (!isfinite(error[best]) || error[0] == error[1])
        return std::nullopt;
    double step = double(best);
    if (best > 0 && best + 1 < error.size()) {
        const double below = error[best - 1] - error[best], above = error[best + 1] - error[best];
        step += below + above > 0 ? 0.5 * (below - above) / (below + above) : 0;
    }
    return step;
}

/// Chooses the smoothing of a pass.
///
/// @param sums        provides the receiver and the response
/// @param count       number of traced photons
/// @param photons     emitted by the whole pass, N_e: the deposits' fluxes and tangents are those of so many photons
/// @param stratified  whether the photons come from a stratified sequence
/// @param deposit_of  deposit_of(i) is the optional deposit of photon i, emitted with smoothing 1
/// @return  s for the pass; `default_smoothing` if too few photons land in view
template <class V, class F, class R, class Policies, class DepositOf, class E>
[[nodiscard]] double cross_validated(const Sums<V, F, R>& sums, const Policies& policies, std::size_t count,
                                     double photons, bool stratified, const DepositOf& deposit_of, E& executor) {
    constexpr double sharpest = 2.5; // below this, footprints hardly overlap, and stratification does not help
    constexpr std::size_t noise_step = 2, most_steps = 9; // the noise is measured at s = 5; s is 40 at most
    constexpr std::size_t fewest = 64;                    // photons that must land
    const auto s_of = [](double step) { return sharpest * std::exp2(0.5 * step); };
    std::size_t landed = 0;
    for (std::size_t i = 0; i < count && landed < fewest; ++i)
        landed += deposit_of(i).has_value();
    if (landed < fewest)
        return default_smoothing;

    announce(executor, Phase::fit);
    QuarterSplatter splat(sums, policies, count, photons, deposit_of, executor);
    std::vector<QuarterPictures> first; // up to the step at which the noise is measured
    for (std::size_t step = 0; step <= noise_step; ++step)
        first.push_back(splat(s_of(double(step))));
    const double order = stratified ? noise_order(first[noise_step]) : 1;

    const std::optional<double> best = best_step(
        [&](std::size_t step) {
            return validated_error(step <= noise_step ? first[step] : splat(s_of(double(step))), first[0], order);
        },
        most_steps);
    if (!isfinite(order) || !best) // no photon in view, or invalid sums
        return default_smoothing;
    return s_of(*best) * std::pow(photons / double(count), 1 / (2 + order));
}

} // namespace nephroid::detail
