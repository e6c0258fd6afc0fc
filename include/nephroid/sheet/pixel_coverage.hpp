// SPDX-License-Identifier: MIT
/// @file  Exactly how much of a triangle lies in a pixel's footprint, from integrals along its edges.
///
/// In the footprint's own coordinates (s, t) it is the unit square. By Green's theorem the area of a polygon within the
/// square is the sum over its edges of ∫ clamp(s, 0, 1) dt, t clamped to [0, 1] as well. Along an edge clamp(s) is
/// piecewise linear, and its mean is a quotient of two differences between the same two ends, so that no digits cancel
/// [include/nephroid/README.md, "Exact coverage"].
#pragma once

#include "nephroid/vector/scalar.hpp"

#include <array>

namespace nephroid::detail {

/// A place in a footprint's coordinates.
template <class R>
struct FootprintPlace {
    R s, t;
};

/// What one edge of a polygon, from a to b, adds to the area within the unit square: positive where t rises. Without a
/// branch, so that a loop over edges is vectorised. |s|, |t| below 10⁸.
template <class R>
[[nodiscard]] inline R edge_integral(R a_s, R a_t, R b_s, R b_t) {
    constexpr R least = R(1e-20); // what is shorter has no area in the precision of R; keeps quotients finite
    // Chosen by arithmetic, as GCC makes branches of conditional expressions around divisions, and then no vector
    // instructions. x + |x| is 2x or 0, exactly.
    const auto clamped = [](R x) {
        const R above = R(0.5) * (x + abs(x));
        return above < R(1) ? above : R(1);
    };
    const R run = b_s - a_s, rise = b_t - a_t;
    const R from_t = clamped(a_t), to_t = clamped(b_t);
    const R level = abs(rise) < least ? R(1) : R(0);
    const R slope = run / (rise + level);
    // Each end is computed from its own corner. If it is not clamped it is exactly the corner, as for the next edge.
    const R from_s = a_s + (from_t - a_t) * slope, to_s = b_s - (b_t - to_t) * slope;
    const R from_l = clamped(from_s), to_l = clamped(to_s);
    const R from_g = from_s > R(1) ? from_s : R(1), to_g = to_s > R(1) ? to_s : R(1);
    const R span = to_s - from_s;
    const R upright = abs(span) < least ? R(1) : R(0);
    const R integral = R(0.5) * (to_l - from_l) * (from_l + to_l) + (to_g - from_g);
    const R quotient = integral / (span + upright);
    const R mean = quotient + upright * (from_l - quotient);
    return (R(1) - level) * ((to_t - from_t) * mean);
}

template <class R>
[[nodiscard]] R edge_integral(const FootprintPlace<R>& a, const FootprintPlace<R>& b) {
    return edge_integral(a.s, a.t, b.s, b.t);
}

/// Twice the signed area of a triangle.
template <class R>
[[nodiscard]] R doubled_area(const std::array<FootprintPlace<R>, 3>& c) {
    return (c[1].s - c[0].s) * (c[2].t - c[0].t) - (c[2].s - c[0].s) * (c[1].t - c[0].t);
}

/// The share of a triangle's area that lies in the unit square, 0 to 1. A triangle almost without area (below
/// 10⁻¹⁰, or 10⁻⁹ of its longest side squared) counts as its longest side, with light spread evenly along it.
template <class R>
[[nodiscard]] R covered_share(const std::array<FootprintPlace<R>, 3>& c) {
    const auto length2 = [&](std::size_t i) {
        const auto &a = c[i], &b = c[(i + 1) % 3];
        return square(b.s - a.s) + square(b.t - a.t);
    };
    std::size_t longest = 0;
    for (std::size_t i = 1; i < 3; ++i)
        longest = length2(i) > length2(longest) ? i : longest;
    const R area = R(0.5) * doubled_area(c);
    if (abs(area) >= R(1e-10) && abs(area) >= R(1e-9) * length2(longest)) {
        const R within = edge_integral(c[0], c[1]) + edge_integral(c[1], c[2]) + edge_integral(c[2], c[0]);
        const R share = within / area;
        return share > R(0) ? (share < R(1) ? share : R(1)) : R(0);
    }
    // On the line between a and b the share is the part of it within the square.
    const auto &a = c[longest], &b = c[(longest + 1) % 3];
    R first(0), last(1);
    const auto clip = [&](R from, R to) {
        const R way = to - from;
        if (way == R(0)) {
            last = from >= R(0) && from < R(1) ? last : R(-1); // half open: it lies in one of two neighbours
            return;
        }
        const R enters = ((way > R(0) ? R(0) : R(1)) - from) / way, leaves = ((way > R(0) ? R(1) : R(0)) - from) / way;
        first = enters > first ? enters : first;
        last = leaves < last ? leaves : last;
    };
    clip(a.s, b.s);
    clip(a.t, b.t);
    if (length2(longest) > R(0))
        return last > first ? last - first : R(0);
    return last >= R(1) ? R(1) : R(0); // a point
}

} // namespace nephroid::detail
