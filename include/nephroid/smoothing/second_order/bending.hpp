// SPDX-License-Identifier: MIT
/// @file  How much the map from light to surface bends within a footprint, and which shape of footprint bends least.
///
/// A footprint of shape S = L Lᵀ bends by
///
///     B(S) = |h|² + 0.3 |t| + (r/2 + 5/(π N)) |L|².
///
/// Here h and t are J⁻¹H and J⁻¹T in coordinates in which the footprint is round, r is the roughness and N the
/// number of photons [include/nephroid/README.md, "Footprints from neighbours"].
#pragma once

#include "nephroid/smoothing/second_order/path_derivatives.hpp"
#include "nephroid/vector/scalar.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace nephroid::detail {

/// Applies J⁻¹ to a vector after projecting it onto the image of J. Stays finite where J is singular.
class EmissionPullback {
public:
    explicit EmissionPullback(const std::array<Double3, 2>& first)
        : first_(first), gram_{inner(first[0], first[0]), inner(first[0], first[1]), inner(first[1], first[1])} {
        determinant_ = (std::max)(gram_.determinant(), 1e-12 * gram_.trace() * gram_.trace());
    }

    [[nodiscard]] Plane2 operator()(const Double3& v) const {
        const double a = inner(first_[0], v), b = inner(first_[1], v);
        const double d = determinant_ > 0 ? 1 / determinant_ : 0;
        return {d * (gram_.yy * a - gram_.xy * b), d * (gram_.xx * b - gram_.xy * a)};
    }

private:
    std::array<Double3, 2> first_;
    Symmetric2 gram_;
    double determinant_;
};

/// exp of the symmetric matrix (p, q; q, −p): stretches by e^|x| along one axis and shrinks by as much across it.
[[nodiscard]] inline PlaneMatrix stretching_matrix(Plane2 x) {
    const double size = std::hypot(x.x, x.y), c = std::cosh(size), s = size > 1e-12 ? std::sinh(size) / size : 1;
    return {{c + s * x.x, s * x.y}, {s * x.y, c - s * x.x}};
}

/// The terms of B in the coordinates of a footprint.
class BendingTerms {
public:
    /// @param limit      of |h|² and |t|: photons do not resolve more bending within one photon's part of the domain
    /// @param isotropic  further bending, the same in every direction
    BendingTerms(const PathDerivatives& map, double limit, double isotropic)
        : isotropic_(Symmetric2::isotropic(isotropic)) {
        const EmissionPullback pull_back(map.first);
        for (std::size_t i = 0; i < 3; ++i)
            second_[i] = pull_back(map.second[i]);
        for (std::size_t i = 0; i < 4; ++i)
            third_[i] = pull_back(map.third[i]);
        if (const double size2 = second2(); size2 > limit)
            for (Plane2& h : second_)
                h = std::sqrt(limit / size2) * h;
        if (const double size2 = third2(); size2 > limit * limit)
            for (Plane2& t : third_)
                t = (limit / std::sqrt(size2)) * t;
    }

    /// B for S = 1 in these coordinates.
    [[nodiscard]] double total() const { return second2() + 0.3 * std::sqrt(third2()) + isotropic_.trace(); }

    /// The gradient of log B by the two parameters of `stretching_matrix`, at no stretch.
    [[nodiscard]] Plane2 slope() const {
        const auto& h = second_;
        const auto& t = third_;
        // Contractions of h and of t with themselves: the positive ones leave two lower indices open, the negative
        // ones the two upper indices.
        Symmetric2 change = 4 * Symmetric2{inner(h[0], h[0]) + inner(h[1], h[1]), inner(h[0], h[1]) + inner(h[1], h[2]),
                                           inner(h[1], h[1]) + inner(h[2], h[2])};
        change += -2 * (Symmetric2::outer(h[0]) + 2 * Symmetric2::outer(h[1]) + Symmetric2::outer(h[2]));
        if (const double size3 = std::sqrt(third2()); size3 > 0) {
            const Symmetric2 lower{inner(t[0], t[0]) + 2 * inner(t[1], t[1]) + inner(t[2], t[2]),
                                   inner(t[0], t[1]) + 2 * inner(t[1], t[2]) + inner(t[2], t[3]),
                                   inner(t[1], t[1]) + 2 * inner(t[2], t[2]) + inner(t[3], t[3])};
            change += (0.9 / size3) * lower;
            change += (-0.3 / size3) * (Symmetric2::outer(t[0]) + 3 * Symmetric2::outer(t[1]) +
                                        3 * Symmetric2::outer(t[2]) + Symmetric2::outer(t[3]));
        }
        change += 2 * isotropic_;
        return (1 / total()) * Plane2{change.xx - change.yy, 2 * change.xy};
    }

    /// The same terms in other coordinates.
    ///
    /// @param axes  takes a vector from the other coordinates to these; its determinant must be 1
    [[nodiscard]] BendingTerms rotated(const PlaneMatrix& axes) const {
        BendingTerms result = *this;
        const PlaneMatrix back = axes.inverse();
        const auto along2 = [&](Plane2 a, Plane2 b) {
            return (a.x * b.x) * second_[0] + ((a.x * b.y + a.y * b.x) * second_[1] + (a.y * b.y) * second_[2]);
        };
        result.second_ = {back(along2(axes.first, axes.first)), back(along2(axes.first, axes.second)),
                          back(along2(axes.second, axes.second))};
        const auto along3 = [&](Plane2 a, Plane2 b, Plane2 c) {
            const double xx = a.x * b.x, xy = a.x * b.y + a.y * b.x, yy = a.y * b.y;
            return (xx * c.x) * third_[0] +
                   ((xx * c.y + xy * c.x) * third_[1] + ((xy * c.y + yy * c.x) * third_[2] + (yy * c.y) * third_[3]));
        };
        result.third_ = {
            back(along3(axes.first, axes.first, axes.first)), back(along3(axes.first, axes.first, axes.second)),
            back(along3(axes.first, axes.second, axes.second)), back(along3(axes.second, axes.second, axes.second))};
        result.isotropic_ = congruent(axes.transposed(), isotropic_);
        return result;
    }

private:
    [[nodiscard]] double second2() const {
        return inner(second_[0], second_[0]) + 2 * inner(second_[1], second_[1]) + inner(second_[2], second_[2]);
    }
    [[nodiscard]] double third2() const {
        return inner(third_[0], third_[0]) + 3 * inner(third_[1], third_[1]) + 3 * inner(third_[2], third_[2]) +
               inner(third_[3], third_[3]);
    }

    std::array<Plane2, 3> second_;
    std::array<Plane2, 4> third_;
    Symmetric2 isotropic_;
};

/// A step of Newton's method towards the stretch with the least log B. Its second derivatives come from differences.
[[nodiscard]] inline Plane2 newton_step(const BendingTerms& bend) {
    constexpr double h = 1e-3, longest = 0.5;
    const Plane2 slope = bend.slope();
    const Plane2 p = (1 / h) * (bend.rotated(stretching_matrix({h, 0})).slope() + -1.0 * slope);
    const Plane2 q = (1 / h) * (bend.rotated(stretching_matrix({0, h})).slope() + -1.0 * slope);
    // log B is convex. It has no curvature along a direction in which B decreases without end, so some is added.
    const Symmetric2 curvature{p.x + 0.01, 0.5 * (p.y + q.x), q.y + 0.01};
    const double d = curvature.determinant();
    const Plane2 step = d > 0 ? (-1 / d) * Plane2{curvature.yy * slope.x - curvature.xy * slope.y,
                                                  curvature.xx * slope.y - curvature.xy * slope.x}
                              : -1.0 * slope;
    const double length = std::hypot(step.x, step.y);
    return length > longest ? (longest / length) * step : step;
}

/// Q: how much the map bends in each direction, per u0². The footprint that bends least has a shape S in proportion to
/// Q⁻¹, and it bends by tr(S Q).
///
/// @param photons    emitted into this domain, N: keeps footprints smaller than the domain
/// @param share      of the photons that took this path (PhotonDensity): each stands for 1/share times as much of the
///                   domain
/// @param roughness  of the map (`roughness`), per u0²
/// @param stretch    upper bound of a footprint's longest over its shortest radius
[[nodiscard]] inline Symmetric2 bending(const PathDerivatives& map, double photons, double share = 1,
                                        double roughness = 0,
                                        double stretch = std::numeric_limits<double>::infinity()) {
    const BendingTerms bend(map, share, 0.5 * roughness + 5 / (pi<double> * photons));
    PlaneMatrix axes{{1, 0}, {0, 1}};
    const auto shape = [&] { return Principal2(congruent(axes, Symmetric2::isotropic(1))); };
    constexpr int most_steps = 16; // usually 6 suffice; a needle takes 12
    for (int step = 0; step < most_steps; ++step) {
        const Plane2 x = newton_step(bend.rotated(axes));
        axes = axes * stretching_matrix(x);
        const Principal2 radii2 = shape();
        if (!(std::hypot(x.x, x.y) > 1e-7) || radii2.larger > 1e6 * radii2.smaller)
            break;
    }
    const Principal2 radii2 = shape();
    const double ratio = (std::min)(std::sqrt(radii2.larger / radii2.smaller), stretch);
    // In coordinates along the longer axis and across it.
    const double along = std::sqrt(ratio), across = 1 / along;
    const Plane2 normal{-radii2.axis.y, radii2.axis.x};
    const double total = bend.rotated({along * radii2.axis, across * normal}).total();
    return (0.5 * total) * radii2.with(1 / ratio, ratio);
}

/// Q for the photons of an area light, whose derivatives are those along a slice: how much a unit step in each
/// direction changes the tangents. The shape is not optimised as in `bending`: the light of all slices together is
/// smooth where a single slice bends, and footprints as long as their own slice allows had a larger error (a ring lit
/// by a disk: 0.058 against 0.052).
[[nodiscard]] inline Symmetric2 slice_bending(const PathDerivatives& map, double photons, double roughness) {
    const EmissionPullback pull_back(map.first);
    const std::array<Plane2, 3> h = {pull_back(map.second[0]), pull_back(map.second[1]), pull_back(map.second[2])};
    const std::array<Plane2, 4> t = {pull_back(map.third[0]), pull_back(map.third[1]), pull_back(map.third[2]),
                                     pull_back(map.third[3])};
    const Symmetric2 second{inner(h[0], h[0]) + inner(h[1], h[1]), inner(h[0], h[1]) + inner(h[1], h[2]),
                            inner(h[1], h[1]) + inner(h[2], h[2])};
    const Symmetric2 third{inner(t[0], t[0]) + 2 * inner(t[1], t[1]) + inner(t[2], t[2]),
                           inner(t[0], t[1]) + 2 * inner(t[1], t[2]) + inner(t[2], t[3]),
                           inner(t[1], t[1]) + 2 * inner(t[2], t[2]) + inner(t[3], t[3])};
    Symmetric2 q = (1 / (std::max)(1.0, second.trace())) * second; // limited as in BendingTerms
    if (third.trace() > 0)
        q += (0.3 * (std::min)(1.0, std::sqrt(third.trace())) / third.trace()) * third;
    return q + Symmetric2::isotropic(0.5 * roughness + 5 / (pi<double> * photons));
}

} // namespace nephroid::detail
