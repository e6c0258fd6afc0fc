// SPDX-License-Identifier: MIT
/// @file  Weighted linear least squares with a few unknowns.
#pragma once

#include "nephroid/vector/language.hpp"

#include <array>
#include <cmath>
#include <cstddef>

namespace nephroid::detail {

/// Solves Σ_i row_i x_i = right for many rows, each with a weight, in the least-squares sense.
///
/// @tparam N      unknowns
/// @tparam Value  of an unknown: a double, or a vector with +, − and a product with a double
template <std::size_t N, class Value>
class LeastSquares {
public:
    /// @param weight  > 0
    void add(const std::array<double, N>& row, const Value& right, double weight) {
        for (std::size_t i = 0; i < N; ++i) {
            const double w = weight * row[i];
            if (w == 0)
                continue;
            for (std::size_t j = 0; j <= i; ++j)
                normal_[i][j] += w * row[j];
            right_[i] = right_[i] + w * right;
        }
    }

    /// Solves for the first n unknowns, with the others set to 0, by Cholesky's decomposition of the matrix scaled to a
    /// unit diagonal.
    ///
    /// @return  whether the rows determine them; if not, `x` is undefined
    [[nodiscard]] bool solve(std::size_t n, std::array<Value, N>& x) const {
        constexpr double least_pivot =
            1e-4; // of 1: the part of a column that is independent of the others, well above rounding
        x = {};
        std::array<double, N> scale;
        for (std::size_t i = 0; i < n; ++i) {
            if (!(normal_[i][i] > 0))
                return false;
            scale[i] = 1 / std::sqrt(normal_[i][i]);
        }
        std::array<std::array<double, N>, N> l{};
        for (std::size_t i = 0; i < n; ++i) {
            Value b = scale[i] * right_[i];
            for (std::size_t j = 0; j <= i; ++j) {
                double sum = normal_[i][j] * scale[i] * scale[j];
                for (std::size_t k = 0; k < j; ++k)
                    sum -= l[i][k] * l[j][k];
                if (j < i) {
                    l[i][j] = sum / l[j][j];
                    b = b - l[i][j] * x[j];
                } else {
                    if (!(sum > least_pivot))
                        return false;
                    l[i][i] = std::sqrt(sum);
                    x[i] = (1 / l[i][i]) * b;
                }
            }
        }
        for (std::size_t i = n; i-- > 0;) {
            for (std::size_t k = i + 1; k < n; ++k)
                x[i] = x[i] - l[k][i] * x[k];
            x[i] = (1 / l[i][i]) * x[i];
        }
        for (std::size_t i = 0; i < n; ++i)
            x[i] = scale[i] * x[i];
        return true;
    }

private:
    std::array<std::array<double, N>, N> normal_{}; // lower triangle
    std::array<Value, N> right_{};
};

} // namespace nephroid::detail
