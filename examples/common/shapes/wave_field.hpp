// SPDX-License-Identifier: MIT
/// @file  Many sine waves on water: a height field, with its slopes and its curvature.
#pragma once

#include "common/ray.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace nephroid::examples {

/// The surface z = height + Σ amplitude sin(2π (kx x + ky y) + phase). Its normal points up.
class WaveField {
public:
    struct Wave {
        double amplitude; ///< world units
        double kx, ky;    ///< waves per unit length
        double phase = 0; ///< radians
    };

    /// Height and derivatives at a place.
    struct Relief {
        double z, z_x, z_y, z_xx, z_xy, z_yy;
    };

    WaveField(double height, std::vector<Wave> waves) : height_(height), waves_(std::move(waves)) {
        for (const Wave& wave : waves_) {
            rise_ += std::abs(wave.amplitude);
            steepest_ += std::abs(wave.amplitude) * 2 * std::numbers::pi * std::hypot(wave.kx, wave.ky);
        }
    }

    [[nodiscard]] Relief at(double x, double y) const {
        Relief relief{height_, 0, 0, 0, 0, 0};
        for (const Wave& wave : waves_) {
            const double u = 2 * std::numbers::pi * wave.kx, v = 2 * std::numbers::pi * wave.ky;
            const double angle = u * x + v * y + wave.phase;
            const double s = wave.amplitude * std::sin(angle), c = wave.amplitude * std::cos(angle);
            relief.z += s;
            relief.z_x += u * c;
            relief.z_y += v * c;
            relief.z_xx -= u * u * s;
            relief.z_xy -= u * v * s;
            relief.z_yy -= v * v * s;
        }
        return relief;
    }

    [[nodiscard]] double highest() const { return height_ + rise_; }
    [[nodiscard]] double lowest() const { return height_ - rise_; }
    /// A bound on the slope.
    [[nodiscard]] double steepest() const { return steepest_; }

    /// The first crossing of a ray at a distance in (t_min, t_max): at once where the ray is steeper than the waves, so
    /// that it crosses once; else in steps that the slopes' bound allows, but for a 256th of the shortest wave.
    [[nodiscard]] std::optional<double> crossing(const Vec3<double>& origin, const Vec3<double>& direction,
                                                 double t_min, double t_max) const {
        const auto above = [&](double t) {
            const Vec3<double> p = origin + t * direction;
            return p.z - at(p.x, p.y).z;
        };
        double from = t_min, to = t_max;
        if (direction.z != 0) { // only between the heights' bounds
            const double a = (highest() - origin.z) / direction.z, b = (lowest() - origin.z) / direction.z;
            from = (std::max)(from, (std::min)(a, b));
            to = (std::min)(to, (std::max)(a, b));
        }
        if (!(from < to) || !std::isfinite(to))
            return std::nullopt;
        const double across = std::hypot(direction.x, direction.y);
        const bool is_steep = std::abs(direction.z) > steepest_ * across;
        const double fastest = std::abs(direction.z) + steepest_ * across; // change of the height above the waves
        double before = above(from);
        for (double t = from; t < to;) {
            const double step = (std::max)(std::abs(before) / fastest, shortest() / (256 * across));
            const double next = is_steep ? to : (std::min)(t + step, to), after = above(next);
            if ((before > 0) != (after > 0))
                return root(origin, direction, t, next, before > 0);
            before = after;
            t = next;
        }
        return std::nullopt;
    }

private:
    [[nodiscard]] double shortest() const {
        double most = 1e-30;
        for (const Wave& wave : waves_)
            most = (std::max)(most, std::hypot(wave.kx, wave.ky));
        return 1 / most;
    }

    /// Newton's method, and bisection where a step leaves the bracket.
    [[nodiscard]] double root(const Vec3<double>& origin, const Vec3<double>& direction, double a, double b,
                              bool begins_above) const {
        double t = 0.5 * (a + b);
        for (int i = 0; i < 64; ++i) {
            const Vec3<double> p = origin + t * direction;
            const Relief relief = at(p.x, p.y);
            const double above = p.z - relief.z;
            ((above > 0) == begins_above ? a : b) = t;
            const double slope = direction.z - relief.z_x * direction.x - relief.z_y * direction.y;
            double next = t - above / slope;
            if (!(next >= a && next <= b))
                next = 0.5 * (a + b);
            if (std::abs(next - t) <= 4e-16 * (std::abs(t) + std::abs(origin.z)))
                return next;
            t = next;
        }
        return t;
    }

    double height_, rise_ = 0, steepest_ = 0;
    std::vector<Wave> waves_;
};

} // namespace nephroid::examples
