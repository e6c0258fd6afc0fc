// SPDX-License-Identifier: MIT
/// @file  Roots of functions of one variable: one in a bracket, and all in an interval.
#pragma once

#include "nephroid/vector/language.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace nephroid::reference::detail {

/// Finds the root between `a` and `b`, where `f` changes its sign from `fa` to `fb`, to about the last bit.
///
/// It interpolates by an inverse quadratic where that is safe, and bisects elsewhere. If the signs agree, it returns
/// the end with the smaller |f|.
/// Source: Chandrupatla 1997, "A new hybrid quadratic/bisection algorithm for finding the zero of a nonlinear
/// function".
template <class F>
[[nodiscard]] double root_between(const F& f, double a, double b, double fa, double fb) {
    if (fa == 0 || fb == 0 || (fa < 0) == (fb < 0))
        return std::abs(fa) < std::abs(fb) ? a : b;
    double c = a, fc = fa, t = 0.5;
    for (int step = 0; step < 100; ++step) {
        const double x = a + t * (b - a), fx = f(x);
        if ((fx < 0) == (fa < 0)) {
            c = a;
            fc = fa;
        } else {
            c = b;
            b = a;
            fc = fb;
            fb = fa;
        }
        a = x;
        fa = fx;
        const double best = std::abs(fa) < std::abs(fb) ? a : b;
        const double least = (4e-16 * std::abs(best) + 1e-300) / std::abs(b - a);
        if (fx == 0 || least > 0.5)
            return best;
        const double xi = (a - b) / (c - b), phi = (fa - fb) / (fc - fb);
        const bool interpolate = phi * phi < xi && (1 - phi) * (1 - phi) < 1 - xi;
        t = interpolate ? fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb) : 0.5;
        t = (std::clamp)(t, least, 1 - least);
    }
    return a;
}

/// As above; evaluates `f` at both ends.
template <class F>
[[nodiscard]] double root_between(const F& f, double a, double b) {
    return root_between(f, a, b, f(a), f(b));
}

/// Appends every root of `f` in [a, b] to `roots`, in increasing order.
///
/// Bisects the interval until the bound on the curvature excludes a root, or `f` is monotonic.
/// @param curvature  a bound on |f''| over [a, b]
/// Two roots closer than 1e-10 may be missed, or be found as one.
template <class F>
void find_roots(const F& f, double a, double b, double fa, double fb, double curvature, std::vector<double>& roots) {
    const double h = b - a;
    const bool same_sign = (fa < 0) == (fb < 0);
    if (same_sign && (std::min)(std::abs(fa), std::abs(fb)) > curvature * h * h / 8)
        return;
    if (h < 1e-10 || std::abs(fb - fa) > curvature * h * h / 2) {
        if (!same_sign)
            roots.push_back(root_between(f, a, b, fa, fb));
        return;
    }
    const double middle = 0.5 * (a + b), fm = f(middle);
    find_roots(f, a, middle, fa, fm, curvature, roots);
    find_roots(f, middle, b, fm, fb, curvature, roots);
}

/// As above; evaluates `f` at both ends, and finds nothing if b <= a.
template <class F>
void find_roots(const F& f, double a, double b, double curvature, std::vector<double>& roots) {
    if (b > a)
        find_roots(f, a, b, f(a), f(b), curvature, roots);
}

} // namespace nephroid::reference::detail
