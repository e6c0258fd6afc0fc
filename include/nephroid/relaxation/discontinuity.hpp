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

namespace nephroid::detail {

/// The point of an axis that splits a row of photons into two sides, each as uniform as can be.
struct Discontinuity {
    double coordinate;  ///< along the axis, over the radius of the disc: in [-1, 1]
    double homogeneity; ///< ι: 1 both sides are alike, 0 one of them is empty
    double evidence;    ///< the logarithm of how many times better two sides explain the row than one whole does
};

/// ι' of eq. 8, clamped to [0, 1]: how firmly a discontinuity of homogeneity ι holds its photons.
[[nodiscard]] inline double constraint_weight(double homogeneity, double alpha, double beta) {
    return std::clamp(1 - (homogeneity - alpha) / (beta - alpha), 0.0, 1.0);
}

/// How far apart candidates for a split are tried: the paper's mean distance between this many photons on a disc of
/// radius 1, 2/(K + 1) √(K/π).
[[nodiscard]] inline double candidate_step(std::size_t count) {
    return 2 / (double(count) + 1) * std::sqrt(double(count) / std::numbers::pi);
}

/// The sums from which the mean and the weighted deviation of one side's gaps follow [eq. 5 and 6].
struct Gaps {
    double count = 0, sum = 0, weight = 0, weighted = 0, weighted2 = 0;

    void add(double gap, double coordinate) {
        const double w = (std::max)(0.0, 1 - coordinate * coordinate);
        count += 1, sum += gap, weight += w, weighted += w * gap, weighted2 += w * gap * gap;
    }
    [[nodiscard]] Gaps without(const Gaps& other) const {
        return {count - other.count, sum - other.sum, weight - other.weight, weighted - other.weighted,
                weighted2 - other.weighted2};
    }
    [[nodiscard]] double mean() const { return sum / count; }
    /// σ over the mean; 0 where all gaps are 0.
    [[nodiscard]] double variation() const {
        const double m = mean();
        const double sum2 = weighted2 - 2 * m * weighted + m * m * weight;
        return m > 0 ? std::sqrt((std::max)(0.0, sum2) / count) / m : 0;
    }
};

/// The fraction of a disc of radius 1 that lies left of x.
[[nodiscard]] inline double disc_left_of(double x) {
    return (std::acos(-x) + x * std::sqrt((std::max)(0.0, 1 - x * x))) / std::numbers::pi;
}

/// x log(x/y), 0 for x = 0
[[nodiscard]] inline double relative_entropy(double x, double y) { return x > 0 ? x * std::log(x / y) : 0; }

/// Splits a row at the photon whose two sides' gaps vary least, among candidates one mean distance apart [eq. 4 to 7].
///
/// @param coordinates  ψ over the radius of the disc, ascending, in [-1, 1]; the ends of the row, ±1, are not among
///                     them
/// @return  each side's gaps include the one that ends at the photon, so that neither is empty; `evidence` is infinite,
///          as this criterion has none. Nothing for an empty row.
template <Scalar T>
[[nodiscard]] std::optional<Discontinuity> least_gap_variation(std::span<const T> coordinates) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Gaps all;
    double before = -1;
    for (const T& coordinate : coordinates) {
        all.add(double(coordinate) - before, double(coordinate));
        before = double(coordinate);
    }
    all.add(1 - before, 1);

    const double step = candidate_step(coordinates.size());
    std::optional<Discontinuity> best;
    double least = infinity, next = -1 + step;
    Gaps left;
    before = -1;
    for (const T& coordinate : coordinates) {
        left.add(double(coordinate) - before, double(coordinate));
        before = double(coordinate);
        if (before < next)
            continue;
        next = before + step;
        const Gaps right = all.without(left);
        const double chi = left.variation() + right.variation();
        if (chi < least) {
            const double low = (std::min)(left.mean(), right.mean()), high = (std::max)(left.mean(), right.mean());
            least = chi;
            best = Discontinuity{before, high > 0 ? low / high : 1, infinity};
        }
    }
    return best;
}

/// Splits a row into the two densities that explain the photons best: the largest likelihood that k of n photons lie
/// left of a line whose fraction u of the disc's area lies left. The homogeneity is the ratio of the two densities.
/// Unlike eq. 4 it knows that chords of a disc are shorter towards its rim, and how many photons there are.
///
/// @param coordinates  as for `least_gap_variation`
template <Scalar T>
[[nodiscard]] std::optional<Discontinuity> most_likely(std::span<const T> coordinates) {
    const double n = double(coordinates.size()), step = candidate_step(coordinates.size());
    std::optional<Discontinuity> best;
    std::size_t best_photon = 0;
    const auto consider = [&](std::size_t photon) {
        const double u = disc_left_of(double(coordinates[photon]));
        if (!(u > 0 && u < 1))
            return;
        for (unsigned passed = 0; passed < 2; ++passed) { // the line passes before the photon, then behind it
            const double k = double(photon + passed);
            const double evidence = relative_entropy(k, n * u) + relative_entropy(n - k, n * (1 - u));
            if (best && evidence <= best->evidence)
                continue;
            const double left = k / u, right = (n - k) / (1 - u);
            best =
                Discontinuity{double(coordinates[photon]), (std::min)(left, right) / (std::max)(left, right), evidence};
            best_photon = photon;
        }
    };
    double next = -1;
    for (std::size_t photon = 0; photon < coordinates.size(); ++photon)
        if (double(coordinates[photon]) >= next) {
            consider(photon);
            next = double(coordinates[photon]) + step;
        }
    if (!best)
        return best;
    // Then every photon near the best candidate.
    const double middle = best->coordinate;
    std::size_t first = best_photon;
    while (first > 0 && double(coordinates[first - 1]) > middle - step)
        --first;
    for (std::size_t photon = first; photon < coordinates.size() && double(coordinates[photon]) < middle + step;
         ++photon)
        consider(photon);
    return best;
}

} // namespace nephroid::detail
