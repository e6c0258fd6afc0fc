// SPDX-License-Identifier: MIT
/// @file  Compares pictures of one set of photons with a sharp picture of photons that are independent of them.
///
/// Derivation: include/nephroid/README.md, "Lamps with area: the size by pictures".
#pragma once

#include "nephroid/smoothing/quarter_pictures.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace nephroid::detail {

/// The picture from all four quarters.
[[nodiscard]] inline std::vector<double> mean_of(const QuarterPictures& q) {
    std::vector<double> mean(q[0].size());
    for (std::size_t i = 0; i < mean.size(); ++i)
        mean[i] = 0.25 * ((q[0][i] + q[1][i]) + (q[2][i] + q[3][i]));
    return mean;
}

/// The variance of that picture, summed over the vertices, if the quarters are independent.
[[nodiscard]] inline double variance_of_mean(const QuarterPictures& q) {
    double sum = 0;
    for (std::size_t i = 0; i < q[0].size(); ++i) {
        const double mean = 0.25 * ((q[0][i] + q[1][i]) + (q[2][i] + q[3][i]));
        for (const std::vector<double>& quarter : q)
            sum += square(quarter[i] - mean) / 12;
    }
    return sum;
}

[[nodiscard]] inline double squared_difference(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += square(a[i] - b[i]);
    return sum;
}

/// The squared difference of the means that two kinds of pictures have, summed over the vertices; without the pictures'
/// noise, as only quarters that have no photon in common are multiplied.
///
/// @param p,q  of the same independent quarters
[[nodiscard]] inline double squared_bias(const QuarterPictures& p, const QuarterPictures& q) {
    double sum = 0;
    for (std::size_t i = 0; i < p[0].size(); ++i) {
        double sum_p = 0, sum_q = 0, pp = 0, qq = 0, pq = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            sum_p += p[k][i], sum_q += q[k][i];
            pp += square(p[k][i]), qq += square(q[k][i]), pq += p[k][i] * q[k][i];
        }
        // All products, less those of a quarter with itself: 12 pairs.
        sum += (square(sum_p) - pp + square(sum_q) - qq - 2 * (sum_p * sum_q - pq)) / 12;
    }
    return sum;
}

/// Compares pictures of the pilot with a sharp one of photons that are independent of it.
class HeldOutPicture {
public:
    /// @param sharp  pictures of its quarters with small footprints
    explicit HeldOutPicture(QuarterPictures sharp) : sharp_(std::move(sharp)), mean_(mean_of(sharp_)) {}

    /// The squared error of a picture, summed over the vertices, plus a constant.
    [[nodiscard]] double error(const std::vector<double>& picture) const { return squared_difference(picture, mean_); }

    /// The standard error of a difference of two errors, from that of the quarters.
    [[nodiscard]] double standard_error(const std::vector<double>& p, const std::vector<double>& q) const {
        std::array<double, 4> products{};
        double mean = 0, square_sum = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            for (std::size_t i = 0; i < p.size(); ++i)
                products[k] += 2 * (p[i] - q[i]) * sharp_[k][i];
            mean += products[k] / 4;
        }
        for (const double product : products)
            square_sum += square(product - mean);
        return std::sqrt(square_sum / 12);
    }

    /// The variance of a stratified picture over that of independent quarters, one minus the part that they fill in of
    /// each other's gaps; nothing where noise hides it.
    ///
    /// @param picture   of stratified photons
    /// @param held_out  with the same footprints, of the held out ones
    [[nodiscard]] std::optional<double> stratification(const QuarterPictures& picture,
                                                       const QuarterPictures& held_out) const {
        const double variance = error(mean_of(picture)) - variance_of_mean(sharp_) - squared_bias(held_out, sharp_);
        const double share = variance / variance_of_mean(picture);
        return share > 0.1 && share < 1.5 ? std::optional(share) : std::nullopt;
    }

private:
    QuarterPictures sharp_;
    std::vector<double> mean_;
};

} // namespace nephroid::detail
