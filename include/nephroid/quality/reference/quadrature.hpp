// SPDX-License-Identifier: MIT
/// @file  Gauss-Legendre quadrature and Chebyshev interpolation, for functions that are analytic on their interval.
#pragma once

#include "nephroid/vector/language.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace nephroid::reference::detail {

/// The N nodes and weights of Gauss-Legendre quadrature on [-1, 1].
template <std::size_t N>
struct GaussLegendre {
    std::array<double, N> node{}, weight{};

    GaussLegendre() {
        for (std::size_t i = 0; i < N; ++i) {
            double x = std::cos(std::numbers::pi * (static_cast<double>(i) + 0.75) / (N + 0.5));
            double slope = 1;
            for (int step = 0; step < 6; ++step) { // Newton, on the Legendre polynomial from its recurrence
                double p = x, before = 1;
                for (std::size_t k = 2; k <= N; ++k) {
                    const auto n = static_cast<double>(k);
                    const double after = ((2 * n - 1) * x * p - (n - 1) * before) / n;
                    before = p;
                    p = after;
                }
                slope = N * (x * p - before) / (x * x - 1);
                x -= p / slope;
            }
            node[i] = x;
            weight[i] = 2 / ((1 - x * x) * slope * slope);
        }
    }
};

/// @return  the integral of `f` from `a` to `b` with N nodes: exact for polynomials up to degree 2N - 1
template <std::size_t N, class F>
[[nodiscard]] double integrate(const F& f, double a, double b) {
    static const GaussLegendre<N> rule;
    const double centre = 0.5 * (a + b), half = 0.5 * (b - a);
    double sum = 0;
    for (std::size_t i = 0; i < N; ++i)
        sum += rule.weight[i] * f(centre + half * rule.node[i]);
    return half * sum;
}

/// The same, in equal panels no longer than `panel`.
template <std::size_t N, class F>
[[nodiscard]] double integrate_panels(const F& f, double a, double b, double panel) {
    const int panels = static_cast<int>((std::fmax)(1.0, std::ceil(std::abs(b - a) / panel)));
    double sum = 0;
    for (int i = 0; i < panels; ++i)
        sum += integrate<N>(f, a + (b - a) * i / panels, a + (b - a) * (i + 1) / panels);
    return sum;
}

/// The polynomial through a function's values at Chebyshev nodes.
class Chebyshev {
public:
    /// @param count  of nodes on [a, b], >= 1; the degree is one less
    template <class F>
    Chebyshev(const F& f, double a, double b, std::size_t count)
        : centre_(0.5 * (a + b)), half_(0.5 * (b - a)), coefficients_(count) {
        const auto n = static_cast<double>(count);
        for (std::size_t i = 0; i < count; ++i) {
            const double angle = std::numbers::pi * (static_cast<double>(i) + 0.5) / n;
            const double value = f(centre_ + half_ * std::cos(angle));
            for (std::size_t k = 0; k < count; ++k)
                coefficients_[k] += (k == 0 ? 1 : 2) / n * value * std::cos(static_cast<double>(k) * angle);
        }
    }

    /// @return  the value at `x` by Clenshaw's recurrence; meaningful on [a, b] only
    [[nodiscard]] double operator()(double x) const {
        const double u = (x - centre_) / half_;
        double b1 = 0, b2 = 0;
        for (std::size_t k = coefficients_.size(); k-- > 1;) {
            const double b0 = coefficients_[k] + 2 * u * b1 - b2;
            b2 = b1;
            b1 = b0;
        }
        return coefficients_[0] + u * b1 - b2;
    }

private:
    double centre_, half_;
    std::vector<double> coefficients_;
};

} // namespace nephroid::reference::detail
