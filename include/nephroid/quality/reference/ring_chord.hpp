// SPDX-License-Identifier: MIT
/// @file  The light between two hits inside a half cylinder mirror, and the flux that it brings to a rectangle.
#pragma once

#include "nephroid/quality/reference/quadrature.hpp"
#include "nephroid/quality/reference/roots.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace nephroid::reference::detail {

/// An axis-aligned rectangle of the floor.
struct Rectangle {
    double x0, x1, y0, y1;
};

/// A segment on the floor: `length` from (x, y) along the unit vector (dx, dy).
struct Segment {
    double x, y, dx, dy, length;

    /// @return  the length of the part inside `r`
    [[nodiscard]] double length_inside(const Rectangle& r) const {
        double from = 0, to = length;
        const auto clip = [&](double p, double d, double low, double high) {
            if (d == 0) {
                to = p >= low && p <= high ? to : 0;
                return;
            }
            const double a = (low - p) / d, b = (high - p) / d;
            from = (std::fmax)(from, (std::fmin)(a, b));
            to = (std::fmin)(to, (std::fmax)(a, b));
        };
        clip(x, dx, r.x0, r.x1);
        clip(y, dy, r.y0, r.y1);
        return (std::fmax)(0.0, to - from);
    }
};

/// The chord between hits k and k + 1 of light that first meets the mirror at (cos phi, sin phi), as phi varies; k = 0
/// comes after the first hit. phi > 0: the other half is the mirror image.
///
/// Seen from above, light follows chords of the unit circle, each of length 2 cos(phi), and reaches the floor after a
/// distance of at most `reach`, depending on the height of the first hit. Every hit turns it by 2 phi + pi.
class Chord {
public:
    /// @param k      number of hits before the last, >= 0
    /// @param reach  horizontal distance that the light from the mirror's upper edge travels, 0 to 2
    /// @param last   chords of phi beyond it are not counted, <= pi/2
    Chord(int k, double reach, double last)
        : k_(k), reach_(reach), first_(reaches(k)), full_((std::min)(reaches(k + 1), last)), last_(last) {}

    [[nodiscard]] double first() const { return first_; } ///< the least phi for which light gets as far as chord k
    [[nodiscard]] double last() const { return last_; }
    [[nodiscard]] double nearest() const { return k_ == 0 ? 0 : std::sin(first_); } ///< least distance from the axis

    /// The segment on which light on chord k reaches the floor. Its flux per length and phi is cos(phi).
    [[nodiscard]] Segment at(double phi) const {
        const double c = std::cos(phi), s = std::sin(phi);
        const double length = (std::min)(reach_ - 2 * k_ * c, 2 * c);
        if (k_ == 0)
            return {c, s, s * s - c * c, -2 * s * c, length};
        const double p = position(phi, k_), d = direction(phi);
        return {std::cos(p), std::sin(p), std::cos(d), std::sin(d), length};
    }

    /// The angles at which the line through the chord passes (x, y).
    void passes_point(double x, double y, std::vector<double>& phis) const {
        const double r = std::hypot(x, y), turns = 2 * (k_ + 1);
        const double sign = k_ % 2 == 0 ? -1 : 1;
        const auto side = [=](double phi) {
            const double angle = turns * phi;
            return sign * (x * std::sin(angle) - y * std::cos(angle)) + std::sin(phi);
        };
        if (r > nearest() && last_ > first_)
            find_roots(side, first_, last_, r * turns * turns + 1, phis);
    }

    /// The angles at which an end of the chord's lit part passes the line x = `value` (`along_y`: y = `value`).
    void ends_pass(double value, bool along_y, std::vector<double>& phis) const {
        const auto from_circle = [=](double phi, int hit) {
            const double angle = position(phi, hit);
            return (along_y ? std::sin(angle) : std::cos(angle)) - value;
        };
        const auto landing = [=, this](double phi) {
            const Segment s = at(phi);
            return (along_y ? s.y + s.length * s.dy : s.x + s.length * s.dx) - value;
        };
        const double here = 2 * k_ + 1, next = 2 * k_ + 3, turns = 2 * (k_ + 1);
        find_roots([&](double phi) { return from_circle(phi, k_); }, first_, last_, here * here, phis);
        find_roots([&](double phi) { return from_circle(phi, k_ + 1); }, full_, last_, next * next, phis);
        find_roots(landing, first_, full_, here * here + reach_ * turns * turns + 4 * k_ * turns + 2 * k_, phis);
        phis.push_back(full_);
    }

    /// @return  the flux that chord k brings to `r`
    /// @param phis  sorted; at least all angles at which another side of the rectangle or end of the chord begins to
    ///              limit the length inside
    [[nodiscard]] double flux(const Rectangle& r, const std::vector<double>& phis) const {
        const auto density = [&](double phi) { return std::cos(phi) * at(phi).length_inside(r); };
        double sum = 0;
        for (std::size_t i = 0; i + 1 < phis.size(); ++i)
            if (phis[i + 1] - phis[i] > 1e-15 && density(0.5 * (phis[i] + phis[i + 1])) > 0)
                sum += integrate_smooth(density, phis[i], phis[i + 1]);
        return sum;
    }

private:
    /// The least phi for which light can be reflected k times more.
    [[nodiscard]] double reaches(int k) const { return 2 * k > reach_ ? std::acos(reach_ / (2 * k)) : 0; }
    /// The angle, seen from the axis, of the hit after `hit` others.
    [[nodiscard]] static double position(double phi, int hit) { return phi + hit * (2 * phi + std::numbers::pi); }
    [[nodiscard]] double direction(double phi) const { return (k_ + 1) * (2 * phi + std::numbers::pi); }

    /// The clipped lengths have poles where the chord is parallel to a side, near which panels must be short. A pole in
    /// the interval or at its ends does not belong to this length, which is finite there.
    template <class F>
    [[nodiscard]] double integrate_smooth(const F& f, double a, double b) const {
        const double spacing = 0.25 * std::numbers::pi / (k_ + 1), width = 0.1 / (k_ + 1);
        double before = spacing * std::floor((a + 1e-13) / spacing), after = spacing * std::ceil((b - 1e-13) / spacing);
        if (a - before < 1e-13)
            before = a - spacing;
        if (after - b < 1e-13)
            after = b + spacing;
        double sum = 0;
        while (a < b) {
            const double h = (std::min)({b - a, width, 2 * (a - before), (after - a) / 1.5});
            const double end = b - a < 1.001 * h ? b : a + h;
            const bool easy = h < 0.2 * width && h < 0.25 * (std::min)(a - before, after - end);
            sum += easy ? integrate<4>(f, a, end) : integrate<10>(f, a, end);
            a = end;
        }
        return sum;
    }

    int k_;
    double reach_, first_, full_, last_;
};

} // namespace nephroid::reference::detail
