// SPDX-License-Identifier: MIT
/// @file  The map from where light meets a glass ball to where it lands, refracted twice, and the flux within a circle
///        on the floor.
#pragma once

#include "nephroid/quality/reference/fresnel.hpp"
#include "nephroid/quality/reference/quadrature.hpp"
#include "nephroid/quality/reference/roots.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace nephroid::reference {

enum class BallLight {
    collimated, ///< along -z, irradiance 1 on horizontal planes
    point       ///< isotropic, 16 W/sr, at (0, 0, 5.25)
};

/// A ball of radius 1 and index 1.5 with its centre at (0, 0, 1.25), above the floor z = 0.
struct Ball {
    BallLight source = BallLight::collimated;
    bool fresnel = false; ///< whether both interfaces reflect a part of the unpolarised light away
};

namespace detail {

/// Rays by their angle of incidence i on the ball, 0 to pi/2, each in its plane through the axis.
///
/// The ball turns a ray towards the axis by 2(i - t), with t the refracted angle. It lands at x = landing(i): up to the
/// crossing on the side where it met the ball, beyond it on the other side.
class BallMap {
public:
    explicit BallMap(const Ball& ball) : ball_(ball) {
        const double grazing = 0.5 * std::numbers::pi;
        const auto descent = [this](double i) { return std::cos(path(i).direction); };
        last_ = descent(grazing) < 0 ? root_between(descent, 0, grazing) : grazing;
        // x rises to the fold, then falls through the axis to the rim: one change of sign in each bracket.
        fold_ = root_between([this](double i) { return landing_slope(i); }, 0, 0.8 * last_);
        crossing_ = root_between([this](double i) { return landing_behind(i, 0); }, fold_, last_);
        rim_radius_ = last_ < grazing ? 1e300 : -landing(last_);
    }

    [[nodiscard]] double fold() const { return fold_; }         ///< i of the ray that lands on the fold
    [[nodiscard]] double crossing() const { return crossing_; } ///< i of the ray that lands on the axis, after the fold
    [[nodiscard]] double last() const { return last_; }         ///< beyond this i rays leave upwards, or miss the ball
    [[nodiscard]] double fold_radius() const { return landing(fold_); }
    [[nodiscard]] double rim_radius() const { return rim_radius_; } ///< of the lit disk; 1e300 if it has no end

    [[nodiscard]] double landing(double i) const {
        const Path at = path(i);
        return std::sin(at.exit) + std::tan(at.direction) * (centre - std::cos(at.exit));
    }

    /// (landing(i) + radius) times the cosine of the descent. It is 0 where the ray lands at this radius behind the
    /// axis, and finite for horizontal rays, whose landing is not.
    [[nodiscard]] double landing_behind(double i, double radius) const {
        const Path at = path(i);
        return (std::sin(at.exit) + radius) * std::cos(at.direction) +
               std::sin(at.direction) * (centre - std::cos(at.exit));
    }

    /// The flux that meets the ball at angles of incidence below i and leaves it downwards.
    [[nodiscard]] double emitted_below(double i) const {
        return integrate_panels<16>(
            [this](double angle) {
                const double b = std::sin(angle), db = std::cos(angle);
                const double emitted = ball_.source == BallLight::collimated
                                           ? 2 * std::numbers::pi * b * db
                                           : intensity * 2 * std::numbers::pi * b * db /
                                                 (distance * distance * std::sqrt(1 - b * b / (distance * distance)));
                const double passed = ball_.fresnel ? transmittance(b, index) : 1; // the same on the way out
                return emitted * passed * passed;
            },
            0, i, 0.4);
    }

private:
    /// The point where the ray leaves, and its direction there: angles from straight down towards +x.
    struct Path {
        double exit, direction;
    };

    static constexpr double index = 1.5, centre = 1.25, distance = 4, intensity = 16;

    [[nodiscard]] double source_angle(double i) const {
        return ball_.source == BallLight::collimated ? 0 : std::asin(std::sin(i) / distance);
    }

    [[nodiscard]] Path path(double i) const {
        const double a = source_angle(i), t = std::asin(std::sin(i) / index);
        return {2 * t - i + a, 2 * t - 2 * i + a};
    }

    [[nodiscard]] double landing_slope(double i) const {
        const Path at = path(i);
        const double sin_i = std::sin(i), cos_i = std::cos(i);
        const double d_t = cos_i / std::sqrt(index * index - sin_i * sin_i);
        const double d_a =
            ball_.source == BallLight::collimated ? 0 : cos_i / std::sqrt(distance * distance - sin_i * sin_i);
        const double tan_d = std::tan(at.direction), cos_d = std::cos(at.direction);
        return (std::cos(at.exit) + tan_d * std::sin(at.exit)) * (2 * d_t - 1 + d_a) +
               (centre - std::cos(at.exit)) * (2 * d_t - 2 + d_a) / (cos_d * cos_d);
    }

    Ball ball_;
    double fold_ = 0, crossing_ = 0, last_ = 0, rim_radius_ = 0;
};

/// The flux on the floor within a distance of the axis, from a table of polynomials (to about 1e-14).
class BallFlux {
public:
    /// @param reach  the largest distance that will be asked for, >= 0
    BallFlux(const BallMap& map, double reach)
        : map_(map), fold_radius_(map.fold_radius()),
          end_((std::min)(map.rim_radius(), (std::max)(reach, fold_radius_))),
          // Two rays land at fold_radius (1 - v^2), on either side of the fold: one function of v in -1 to 1, with its
          // nearest singularity at -sqrt(2), where the mirror image of the fold would be.
          near_fold_([&](double v) { return map.emitted_below(at_fold(v)); }, -1, 1, 48) {
        // The third ray crosses the axis; its flux is smooth in asinh(radius / fold radius), the next singularity at
        // -0.88.
        const auto count = static_cast<std::size_t>(std::ceil(std::asinh(end_ / fold_radius_) / 0.5));
        panel_ = std::asinh(end_ / fold_radius_) / static_cast<double>(count);
        for (std::size_t k = 0; k < count; ++k)
            behind_.emplace_back([&](double s) { return map.emitted_below(behind(fold_radius_ * std::sinh(s))); },
                                 static_cast<double>(k) * panel_, static_cast<double>(k + 1) * panel_, 20U);
    }

    [[nodiscard]] const BallMap& map() const { return map_; }

    /// @param radius  world units, 0 to `reach`
    [[nodiscard]] double within(double radius) const {
        const double s = std::asinh((std::min)(radius, end_) / fold_radius_);
        const auto k = (std::min)(static_cast<std::size_t>(s / panel_), behind_.size() - 1);
        const double behind_axis = behind_[k](s);
        if (radius >= fold_radius_)
            return behind_axis;
        const double v = std::sqrt(1 - radius / fold_radius_);
        return behind_axis - (near_fold_(v) - near_fold_(-v));
    }

private:
    [[nodiscard]] double at_fold(double v) const {
        const double radius = fold_radius_ * (1 - v * v);
        const auto miss = [&](double i) { return map_.landing(i) - radius; };
        return v < 0 ? root_between(miss, 0, map_.fold()) : root_between(miss, map_.fold(), map_.crossing());
    }

    [[nodiscard]] double behind(double radius) const {
        return root_between([&](double i) { return map_.landing_behind(i, radius); }, map_.crossing(), map_.last());
    }

    BallMap map_;
    double fold_radius_, end_, panel_ = 1;
    Chebyshev near_fold_;
    std::vector<Chebyshev> behind_;
};

} // namespace detail
} // namespace nephroid::reference
