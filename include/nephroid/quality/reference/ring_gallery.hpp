// SPDX-License-Identifier: MIT
/// @file  Light that is reflected so often inside a half cylinder mirror that its chords are nearly arcs.
#pragma once

#include "nephroid/quality/reference/quadrature.hpp"
#include "nephroid/quality/reference/ring_chord.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nephroid::reference::detail {

/// Light that first meets the mirror at phi near pi/2, close to (0, 1), and creeps along it as sound does along the
/// wall of a whispering gallery.
///
/// With q = cos^2(phi) / 2 and u in -1 to 1 along a chord, radius^2 = 1 - 2 q (1 - u^2), and the flux per dq and per
/// length is 1 / sin(phi). It is assumed uniform over u and over an arc from phi clockwise, with an error of at most q.
class Gallery {
public:
    /// @return  how many chords to compute one by one, so that the others stay within 1/2000 of a pixel's side of the
    ///          mirror; at most 1000, which sides below 1e-4 would exceed
    [[nodiscard]] static int chords_before(double reach, double side) {
        return static_cast<int>(std::ceil((std::clamp)(0.5 * reach / std::sqrt(2 * 0.0005 * side), 8.0, 1000.0)));
    }

    /// @param chords  the least number of chords that light follows to count here, >= 1
    Gallery(double reach, int chords) : reach_(reach), cos_first_(0.5 * reach / chords) {}

    [[nodiscard]] double first() const { return std::acos(cos_first_); } ///< the least phi that counts here

    /// @return  the flux that this light brings to `r`
    [[nodiscard]] double flux(const Rectangle& r) const {
        const double depth = 0.5 * cos_first_ * cos_first_; // the greatest q
        const double x_far = (std::fmax)(std::abs(r.x0), std::abs(r.x1)),
                     y_far = (std::fmax)(std::abs(r.y0), std::abs(r.y1));
        const double x_near = (std::fmax)(0.0, (std::fmax)(r.x0, -r.x1)),
                     y_near = (std::fmax)(0.0, (std::fmax)(r.y0, -r.y1));
        if (std::hypot(x_far, y_far) < 1 - depth || std::hypot(x_near, y_near) > 1 || r.x1 < 0)
            return 0;
        return integrate<4>(
            [&](double q) {
                const double c = std::sqrt(2 * q), phi = std::acos(c), angle_per_length = std::asin(c) / c;
                const auto at = [&](double u) {
                    return arc(std::sqrt(1 - 2 * q * (1 - u * u)), phi - reach_ * angle_per_length, phi, r);
                };
                return integrate<6>(at, 0, 1) / (angle_per_length * std::sqrt(1 - 2 * q));
            },
            0, depth);
    }

private:
    /// The angle of the part inside the rectangle of an arc about the axis, from `begin` to `end`, radians from the +x
    /// axis, 0 to pi/2.
    [[nodiscard]] static double arc(double radius, double begin, double end, const Rectangle& r) {
        // In this quadrant each side crosses the arc once at most.
        const auto angle = [radius](double x) { return std::acos((std::clamp)(x / radius, -1.0, 1.0)); };
        const double low = (std::max)({begin, angle(r.x1), 0.5 * std::numbers::pi - angle(r.y0)});
        const double high = (std::min)({end, angle(r.x0), 0.5 * std::numbers::pi - angle(r.y1)});
        return (std::fmax)(0.0, high - low);
    }

    double reach_, cos_first_;
};

} // namespace nephroid::reference::detail
