// SPDX-License-Identifier: MIT
/// @file  The exact caustic of a glass ball on the floor below it.
#pragma once

#include "nephroid/execution/thread_executor.hpp"
#include "nephroid/quality/reference/ball_map.hpp"
#include "nephroid/quality/reference/film.hpp"
#include "nephroid/quality/reference/quadrature.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

namespace nephroid::reference {
namespace detail {

inline void check(const Ball& ball) {
    require(ball.source == BallLight::collimated || ball.source == BallLight::point, "ball", "source",
            static_cast<double>(ball.source), "be a BallLight");
}

/// The flux of a vector field through one side of a pixel. The field points away from the axis, has the size
/// F(rho) / (2 pi rho) with F(rho) the flux on the floor within rho of the axis, and its divergence is the irradiance.
///
/// The side lies on the line at the signed distance `x` from the axis, from `y0` to `y1` along it. The flux is an
/// integral of F over the angle seen from the axis; the substitution y = |x| sinh(s) makes it smooth.
[[nodiscard]] inline double edge_flux(const BallFlux& flux, double x, double y0, double y1) {
    const double d = std::abs(x);
    if (d == 0)
        return 0;
    const double s0 = std::asinh(y0 / d), s1 = std::asinh(y1 / d);
    // Where the line crosses the circles at which F is not analytic: at the rim it has a kink, at the fold a root.
    const auto crossing = [d](double radius) { return radius > d ? std::acosh(radius / d) : 0; };
    const double fold = crossing(flux.map().fold_radius()), rim = crossing(flux.map().rim_radius());

    // In equal panels; short ones need few nodes. The poles of 1/cosh are at +-i pi/2.
    const auto panels = [](const auto& f, double a, double b, double scale) {
        return scale * (b - a) < 0.04 && b - a < 0.04 ? integrate<4>(f, a, b)
                                                      : integrate_panels<10>(f, a, b, 0.4 / (std::fmax)(1.0, scale));
    };
    const auto smooth = [&](double s) { return flux.within(d * std::cosh(s)) / std::cosh(s); };
    // Within the fold, s = fold sin(tau) removes the square roots at both crossings.
    const auto folded = [&](double tau) { return smooth(fold * std::sin(tau)) * fold * std::cos(tau); };

    const std::array<double, 6> ends{-std::numeric_limits<double>::infinity(), -rim, -fold, fold, rim,
                                     std::numeric_limits<double>::infinity()};
    double sum = 0;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        const double a = (std::clamp)(s0, ends[i], ends[i + 1]), b = (std::clamp)(s1, ends[i], ends[i + 1]);
        if (b <= a)
            continue;
        sum += i == 2 ? panels(folded, std::asin(a / fold), std::asin(b / fold), fold) : panels(smooth, a, b, 1);
    }
    return std::copysign(sum / (2 * std::numbers::pi), x);
}

} // namespace detail

/// The flux that reaches a disk on the floor through the ball.
///
/// @param radius  of the disk about the axis, world units, >= 0; infinity for the whole floor
/// @return  exact to about 1e-13
/// Throws `std::invalid_argument` if an argument is out of range.
[[nodiscard]] inline double ball_flux(const Ball& ball, double radius) {
    detail::check(ball);
    detail::require(radius >= 0, "ball_flux", "radius", radius, "be at least 0");
    const detail::BallMap map(ball);
    return std::isinf(radius) ? map.emitted_below(map.last()) : detail::BallFlux(map, radius).within(radius);
}

/// The radius of the ring-shaped fold on the floor, world units.
[[nodiscard]] inline double ball_fold_radius(const Ball& ball) {
    detail::check(ball);
    return detail::BallMap(ball).fold_radius();
}

/// Computes the caustic on the floor below a glass ball, of the light refracted exactly twice.
///
/// @param film      any rectangle. On the axis and at the fold the irradiance is infinite, but its averages are not.
/// @param executor  who runs the work; the result does not depend on it, bit for bit
/// @return  irradiances averaged over the pixels. A pixel is a difference of fluxes, so it is exact to about
///          1e-14 * (flux within its distance from the axis) / (that distance * the pixel's side), plus 1e-12 of itself
///          (measured on the films of the tests: 1e-10 of the pixel or of a hundredth of the mean).
/// Throws `std::invalid_argument` if the source or the film is out of range.
template <ExecutorArgument E = ThreadExecutor>
[[nodiscard]] Image ball(const Ball& ball, const Film& film, E&& executor = E{}) {
    Image image = detail::blank(film, "ball");
    detail::check(ball);
    const double reach = std::hypot((std::max)(std::abs(film.x_min), std::abs(film.x_max)),
                                    (std::max)(std::abs(film.y_min), std::abs(film.y_max)));
    const detail::BallFlux flux(detail::BallMap(ball), reach);

    executor(static_cast<std::size_t>(film.height), [&](std::size_t row_number) {
        const int j = static_cast<int>(row_number);
        const double y0 = film.y(j), y1 = film.y(j + 1);
        double left = detail::edge_flux(flux, film.x(0), y0, y1);
        for (int i = 0; i < film.width; ++i) {
            const double x0 = film.x(i), x1 = film.x(i + 1);
            const double right = detail::edge_flux(flux, x1, y0, y1);
            const double out = right - left + detail::edge_flux(flux, y1, x0, x1) - detail::edge_flux(flux, y0, x0, x1);
            image[static_cast<std::size_t>(j) * static_cast<std::size_t>(film.width) + static_cast<std::size_t>(i)] =
                out / ((x1 - x0) * (y1 - y0));
            left = right;
        }
    });
    return image;
}

} // namespace nephroid::reference
