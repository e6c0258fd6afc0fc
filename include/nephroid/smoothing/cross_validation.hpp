// SPDX-License-Identifier: MIT
/// @file  One smoothing for all photons of a pass, chosen by comparing estimates from parts of them: where nothing is
///        known of the light but its photons.
///
/// With W the picture from all photons at one smoothing, A and B those from either half of them, and A₀ and B₀ the
/// halves at a small smoothing, the sum over the vertices of W² − A B₀ − B A₀ is the squared error of W on
/// average, but for a constant and for what the halves of a sequence know of each other. Where that comes from, and how
/// s grows with the number of photons, is told in include/nephroid/README.md, "Cross-validation".
#pragma once

#include "nephroid/execution/executor.hpp"
#include "nephroid/pass/photon_pass.hpp"
#include "nephroid/smoothing/quarter_pictures.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace nephroid::detail {

/// How the noise of an estimate falls with the number n of its photons, as n^−β: 1 for random ones, 2 for those that
/// avoid each other in the plane of their footprints.
[[nodiscard]] inline double noise_order(const QuarterPictures& q) {
    double quarters = 0, halves = 0;
    for (std::size_t i = 0; i < q[0].size(); ++i) {
        quarters += 0.5 * (square(q[0][i] - q[1][i]) + square(q[2][i] - q[3][i]));
        halves += 0.25 * square((q[0][i] + q[1][i]) - (q[2][i] + q[3][i]));
    }
    return halves > 0 ? std::clamp(std::log2(quarters / halves), 1.0, 2.0) : 1;
}

/// The squared error of the picture from all quarters together, summed over the vertices, but for a constant.
///
/// @param sharp  the same at a small smoothing
/// @param order  noise_order
[[nodiscard]] inline double validated_error(const QuarterPictures& q, const QuarterPictures& sharp, double order) {
    const double correlation = std::exp2(1 - order) - 1;
    double error = 0, difference = 0;
    for (std::size_t i = 0; i < q[0].size(); ++i) {
        const double a = 0.5 * (q[0][i] + q[1][i]), b = 0.5 * (q[2][i] + q[3][i]);
        const double a0 = 0.5 * (sharp[0][i] + sharp[1][i]), b0 = 0.5 * (sharp[2][i] + sharp[3][i]);
        error += square(0.5 * (a + b)) - a * b0 - b * a0 + a0 * b0; // the last does not depend on s: smaller numbers
        difference += (a - b) * (a0 - b0);
    }
    return error + correlation / (1 - correlation) * difference;
}

/// @param sums        tells map and response
/// @param count       photons at hand
/// @param photons     of the pass, N_e: what the deposits were emitted as parts of
/// @param stratified  whether they are from a sequence that is
/// @param deposit_of  deposit_of(i) -> optional deposit of photon i, emitted with smoothing 1
/// @return  s for the pass; `default_smoothing` where too few photons are seen to tell
template <class V, class F, class R, class Policies, class DepositOf, class E>
[[nodiscard]] double cross_validated(const Sums<V, F, R>& sums, const Policies& policies, std::size_t count,
                                     double photons, bool stratified, const DepositOf& deposit_of, E& executor) {
    constexpr double sharpest = 2.5; // below, footprints hardly overlap, and a sequence's photons are as random ones
    constexpr std::size_t measured = 2, most = 9; // s = 5 for the noise, and up to 40
    constexpr std::size_t fewest = 64;            // that landed
    const auto s_of = [](double step) { return sharpest * std::exp2(0.5 * step); };
    std::size_t landed = 0;
    for (std::size_t i = 0; i < count && landed < fewest; ++i)
        landed += deposit_of(i).has_value();
    if (landed < fewest)
        return default_smoothing;

    announce(executor, Phase::fit);
    QuarterSplatter splat(sums, policies, count, photons, deposit_of, executor);
    std::vector<QuarterPictures> first; // those up to where the noise is measured
    for (std::size_t step = 0; step <= measured; ++step)
        first.push_back(splat(s_of(double(step))));
    const double order = stratified ? noise_order(first[measured]) : 1;

    std::vector<double> error;
    std::size_t best = 0;
    for (std::size_t step = 0; step < most && step <= best + 2; ++step) { // twice in a row worse: it is the minimum
        error.push_back(validated_error(step <= measured ? first[step] : splat(s_of(double(step))), first[0], order));
        if (error[step] < error[best])
            best = step;
    }
    if (!isfinite(order) || !isfinite(error[best]) || error[0] == error[1]) // nothing is seen, or it is no number
        return default_smoothing;
    double step = double(best);
    if (best > 0 && best + 1 < error.size()) { // the parabola through it and its neighbours
        const double below = error[best - 1] - error[best], above = error[best + 1] - error[best];
        step += below + above > 0 ? 0.5 * (below - above) / (below + above) : 0;
    }
    return s_of(step) * std::pow(photons / double(count), 1 / (2 + order));
}

} // namespace nephroid::detail
