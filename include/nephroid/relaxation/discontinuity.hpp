// SPDX-License-Identifier: MIT
/// @file  Where the density of a row of photons changes: eq. 4 to 8 of Spencer and Jones 2009, and by likelihood.
#pragma once

#include "nephroid/vector/scalar.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <span>

namespace nephroid {

/// A place along an axis whose two sides are each as uniform as can be.
struct Discontinuity {
    double place;       ///< along the axis, over the radius of the disc: in [-1, 1]
    double homogeneity; ///< ι: 1 both sides are alike, 0 one of them is empty
    double evidence;    ///< the logarithm of how many times better two sides explain the row than one whole does
};

/// ι' of eq. 8, clamped to [0, 1]: how firmly a discontinuity of homogeneity ι holds its photons.
[[nodiscard]] inline double constraint_weight(double homogeneity, double alpha, double beta) {
    return std::clamp(1 - (homogeneity - alpha) / (beta - alpha), 0.0, 1.0);
}

namespace detail {

/// The mean distance between as many photons on a disc of radius 1 as this, by the paper's 2/(K + 1) √(K/π):
/// candidates are tried so far apart.
[[nodiscard]] inline double candidate_step(std::size_t count) {
    return 2 / (double(count) + 1) * std::sqrt(double(count) / std::numbers::pi);
}

/// The sums from which the mean and the weighted spread of one side's gaps follow [eq. 5 and 6].
struct Gaps {
    double count = 0, sum = 0, weight = 0, weighted = 0, weighted2 = 0;

    void add(double gap, double place) {
        const double w = (std::max)(0.0, 1 - place * place);
        count += 1, sum += gap, weight += w, weighted += w * gap, weighted2 += w * gap * gap;
    }
    [[nodiscard]] Gaps without(const Gaps& other) const {
        return {count - other.count, sum - other.sum, weight - other.weight, weighted - other.weighted,
                weighted2 - other.weighted2};
    }
    [[nodiscard]] double mean() const { return sum / count; }
    /// σ over the mean; 0 where all gaps are
    [[nodiscard]] double variation() const {
        const double m = mean();
        const double sum2 = weighted2 - 2 * m * weighted + m * m * weight;
        return m > 0 ? std::sqrt((std::max)(0.0, sum2) / count) / m : 0;
    }
};

/// The share of a disc of radius 1 that lies left of x.
[[nodiscard]] inline double disc_left_of(double x) {
    return (std::acos(-x) + x * std::sqrt((std::max)(0.0, 1 - x * x))) / std::numbers::pi;
}

/// x log(x/y), 0 for x = 0
[[nodiscard]] inline double relative_entropy(double x, double y) { return x > 0 ? x * std::log(x / y) : 0; }

} // namespace detail

/// The photon that splits a row into two of least spread, of candidates at the mean distance of photons [eq. 4 to 7].
///
/// @param places  ψ over the radius of the disc, ascending, in [-1, 1]; the ends of the row, ±1, are not among them
/// @return  the two sides' gaps include the one up to the photon and the one from it, so that neither is empty;
///          `evidence` is not asked for and infinite. Nothing for an empty row.
template <Scalar T>
[[nodiscard]] std::optional<Discontinuity> least_spread(std::span<const T> places) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    detail::Gaps all;
    double before = -1;
    for (const T& place : places) {
        all.add(double(place) - before, double(place));
        before = double(place);
    }
    all.add(1 - before, 1);

    const double step = detail::candidate_step(places.size());
    std::optional<Discontinuity> best;
    double least = infinity, next = -1 + step;
    detail::Gaps left;
    before = -1;
    for (const T& place : places) {
        left.add(double(place) - before, double(place));
        before = double(place);
        if (before < next)
            continue;
        next = before + step;
        const detail::Gaps right = all.without(left);
        const double chi = left.variation() + right.variation();
        if (chi < least) {
            const double low = (std::min)(left.mean(), right.mean()), high = (std::max)(left.mean(), right.mean());
            least = chi;
            best = Discontinuity{before, high > 0 ? low / high : 1, infinity};
        }
    }
    return best;
}

/// The split of a row into two densities that explains the photons best: the largest likelihood of k of n photons on
/// the left of a line, whose share of the disc's area is u, against n u of them. The homogeneity is the ratio of the
/// two densities. Unlike eq. 4 it knows that lines across a disc are shorter towards its rim, and how many photons
/// speak.
///
/// @param places  as for `least_spread`
template <Scalar T>
[[nodiscard]] std::optional<Discontinuity> most_likely(std::span<const T> places) {
    const double n = double(places.size()), step = detail::candidate_step(places.size());
    std::optional<Discontinuity> best;
    std::size_t best_photon = 0;
    const auto consider = [&](std::size_t photon) {
        const double u = detail::disc_left_of(double(places[photon]));
        if (!(u > 0 && u < 1))
            return;
        for (const double k : {double(photon), double(photon) + 1}) { // the line passes before or behind the photon
            const double evidence = detail::relative_entropy(k, n * u) + detail::relative_entropy(n - k, n * (1 - u));
            if (best && evidence <= best->evidence)
                continue;
            const double left = k / u, right = (n - k) / (1 - u);
            best = Discontinuity{double(places[photon]), (std::min)(left, right) / (std::max)(left, right), evidence};
            best_photon = photon;
        }
    };
    double next = -1;
    for (std::size_t photon = 0; photon < places.size(); ++photon)
        if (double(places[photon]) >= next) {
            consider(photon);
            next = double(places[photon]) + step;
        }
    if (!best)
        return best;
    // Then every photon about the best candidate.
    const double place = best->place;
    std::size_t first = best_photon;
    while (first > 0 && double(places[first - 1]) > place - step)
        --first;
    for (std::size_t photon = first; photon < places.size() && double(places[photon]) < place + step; ++photon)
        consider(photon);
    return best;
}

} // namespace nephroid
