// SPDX-License-Identifier: MIT
/// @file  Tells an edge of density from a slope: how well a density that grows evenly explains a disc of photons.
#pragma once

#include "nephroid/vector/language.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace nephroid::detail {

/// The mean of exp(a x) over the unit disc, 2 I₁(a)/a with I₁ the modified Bessel function, and that of x exp(a x),
/// its derivative 2 I₂(a)/a.
struct DiscExponential {
    double mean, slope;
};

/// @param a  in [0, 16]: the series' terms fall from the a/2-th on, and the fortieth is below 1e-12 of the sum
[[nodiscard]] inline DiscExponential disc_exponential(double a) {
    const double quarter2 = 0.25 * a * a;
    double term = 1; // (a²/4)^m / (m! (m + 1)!)
    DiscExponential sum{0, 0};
    for (int m = 0; m < 40; ++m) {
        sum.mean += term;
        term *= quarter2 / ((m + 1.0) * (m + 2.0));
        // The next term's derivative, 2 (m + 1)/a times it.
        sum.slope += a > 0 ? term * 2 * (m + 1) / a : 0;
    }
    return sum;
}

/// The logarithm of how many times better a density ∝ exp(a x) explains photons in the unit disc than an even one
/// does, for the a that explains them best: n (a x̄ − ln(2 I₁(a)/a)). Its derivative vanishes where the disc's own
/// mean of x is x̄.
///
/// @param count  n
/// @param mean   x̄, the photons' mean coordinate along their gradient, in [0, 1]
[[nodiscard]] inline double slope_evidence(std::size_t count, double mean) {
    double low = 0, high = 16; // the density's logarithm grows by up to 32 from one side to the other
    for (int halving = 0; halving < 24; ++halving) {
        const double a = 0.5 * (low + high);
        const DiscExponential disc = disc_exponential(a);
        (disc.slope < mean * disc.mean ? low : high) = a;
    }
    const double a = 0.5 * (low + high);
    return double(count) * (std::max)(0.0, a * mean - std::log(disc_exponential(a).mean));
}

} // namespace nephroid::detail
