// SPDX-License-Identifier: MIT
/// @file  The exact caustic of a sinusoidal water wave on the floor below it.
#pragma once

#include "nephroid/execution/thread_executor.hpp"
#include "nephroid/quality/reference/film.hpp"
#include "nephroid/quality/reference/fresnel.hpp"
#include "nephroid/quality/reference/quadrature.hpp"
#include "nephroid/quality/reference/roots.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace nephroid::reference {

/// Water of index 1.33 below the surface z = 1 + amplitude sin(2 pi (2x + y)), lit along -z with irradiance 1 on
/// horizontal planes. The pattern on the floor z = 0 has period 1 in x and in y.
struct Wave {
    double amplitude = 0.04; ///< world units, 0 to 0.1. 0.04 folds ("focused"), 0.012 does not ("prefocal")
    bool fresnel = false;    ///< whether the surface reflects a part of the unpolarised light away
};

namespace detail {

inline constexpr double wave_index = 1.33;

/// The map from t = 2x + y where light enters the water to 2x + y = landing(t) where it lands; nothing else matters.
class WaveMap {
public:
    explicit WaveMap(const Wave& wave) : wave_(wave), breaks_{0.0} {
        const auto slope = [this](double t) { return landing_slope(t); };
        constexpr int cells = 1024; // a pair of folds closer than one cell is neglected
        for (int i = 0; i < cells; ++i) {
            const double a = static_cast<double>(i) / cells, b = static_cast<double>(i + 1) / cells;
            if ((slope(a) < 0) != (slope(b) < 0))
                breaks_.push_back(root_between(slope, a, b));
        }
        breaks_.push_back(1.0);
        for (const double t : breaks_)
            landings_.push_back(landing(t));
    }

    [[nodiscard]] double landing(double t) const {
        const Surface at = surface(t);
        return t + root5 * at.height * at.tan_turn;
    }

    [[nodiscard]] double landing_slope(double t) const {
        const Surface at = surface(t);
        const double tilt_slope = -root5 * 4 * pi * pi * (at.height - 1); // d tilt / dt
        const double cos_in2 = 1 / (1 + at.tilt * at.tilt), sin_out2 = (1 - cos_in2) / (wave_index * wave_index);
        const double d_turn_d_tilt = cos_in2 * (1 - std::sqrt(cos_in2 / (1 - sin_out2)) / wave_index);
        const double d_tan_turn = (1 + at.tan_turn * at.tan_turn) * d_turn_d_tilt * tilt_slope;
        return 1 + at.tilt * at.tan_turn + root5 * at.height * d_tan_turn;
    }

    /// The fraction of the light that passes the surface.
    [[nodiscard]] double transmitted(double t) const {
        if (!wave_.fresnel)
            return 1;
        const double tilt = surface(t).tilt;
        return transmittance(std::abs(tilt) / std::sqrt(1 + tilt * tilt), wave_index);
    }

    /// The irradiance averaged over a pixel whose least 2x + y is `w`; 2x + y grows by `a` and `b` along its two sides.
    /// Over the pixel 2x + y has a trapezoidal density, whose corners are the knots.
    [[nodiscard]] double pixel(double w, double a, double b) const {
        const std::array<double, 4> knots{w, w + (std::min)(a, b), w + (std::max)(a, b), w + a + b};
        const auto [lowest, highest] = std::minmax_element(landings_.begin(), landings_.end());
        double sum = 0;
        for (double period = std::floor(knots[0] - *highest); period <= std::ceil(knots[3] - *lowest); ++period)
            for (std::size_t piece = 0; piece + 1 < breaks_.size(); ++piece)
                sum += from_piece(piece, period, knots);
        return sum / (a * b);
    }

private:
    struct Surface {
        double height, tilt, tan_turn; ///< z, its slope along the steepest direction, tangent of the light's turn
    };

    static constexpr double pi = std::numbers::pi;
    inline static const double root5 = std::sqrt(5.0); // 2x + y grows by this per unit along (2, 1)

    [[nodiscard]] Surface surface(double t) const {
        const double phase = 2 * pi * (t - std::floor(t));
        const double tilt = root5 * 2 * pi * wave_.amplitude * std::cos(phase);
        const double secant = std::sqrt(1 + tilt * tilt), sin_out = tilt / secant / wave_index;
        const double tan_out = sin_out / std::sqrt(1 - sin_out * sin_out);
        return {1 + wave_.amplitude * std::sin(phase), tilt, (tilt - tan_out) / (1 + tilt * tan_out)};
    }

    /// The flux that enters in one monotonic piece of the map and lands in the pixel, times the pixel's a * b.
    [[nodiscard]] double from_piece(std::size_t piece, double period, const std::array<double, 4>& knots) const {
        const double low = (std::min)(landings_[piece], landings_[piece + 1]) + period;
        const double high = (std::max)(landings_[piece], landings_[piece + 1]) + period;
        if (high <= knots[0] || low >= knots[3])
            return 0;
        const auto enters = [&](double landed) {
            return root_between([&](double t) { return landing(t) - (landed - period); }, breaks_[piece],
                                breaks_[piece + 1], landings_[piece] - (landed - period),
                                landings_[piece + 1] - (landed - period));
        };
        double sum = 0, from = enters((std::clamp)(knots[0], low, high));
        for (std::size_t i = 0; i < 3; ++i) {
            if (knots[i + 1] <= low || knots[i] >= high)
                continue;
            const double to = enters((std::min)(knots[i + 1], high));
            const auto landed = [&](double t) {
                const double at = landing(t) + period;
                const double height = i == 0 ? at - knots[0] : i == 1 ? knots[1] - knots[0] : knots[3] - at;
                return height * transmitted(t);
            };
            // The integrand's nearest singularity is 0.21 off the real axis at amplitude 0.04, 0.10 at 0.1.
            sum += std::abs(integrate_panels<10>(landed, from, to, 0.04));
            from = to;
        }
        return sum;
    }

    Wave wave_;
    std::vector<double> breaks_, landings_; ///< ends of the monotonic pieces within one period, and where they land
};

inline void check(const Wave& wave) {
    require(wave.amplitude >= 0 && wave.amplitude <= 0.1, "wave", "amplitude", wave.amplitude, "lie in 0 to 0.1");
}

} // namespace detail

/// The mean irradiance on the floor: the mean transmittance of the surface, 1 without Fresnel loss.
/// Throws `std::invalid_argument` for an amplitude out of range.
[[nodiscard]] inline double wave_mean(const Wave& wave) {
    detail::check(wave);
    const detail::WaveMap map(wave);
    return detail::integrate_panels<10>([&](double t) { return map.transmitted(t); }, 0, 1, 0.04);
}

/// Computes the caustic on the floor below a wave.
///
/// @param film      any rectangle; a pixel that covers more periods costs more
/// @param executor  who runs the work; the result does not depend on it, bit for bit
/// @return  irradiances averaged over the pixels, each to about 1e-12 of itself (1e-11 for 4096 pixels per unit)
/// Throws `std::invalid_argument` if the amplitude or the film is out of range.
template <ExecutorArgument E = ThreadExecutor>
[[nodiscard]] Image wave(const Wave& wave, const Film& film, E&& executor = E{}) {
    Image image = detail::blank(film, "wave");
    detail::check(wave);
    const detail::WaveMap map(wave);
    const double a = 2 * film.pixel_width(), b = film.pixel_height();
    const double least = 2 * film.x_min + film.y_min;
    const auto columns = static_cast<std::size_t>(film.width);
    const auto row = [&](int j) { return image.begin() + static_cast<std::ptrdiff_t>(columns) * j; };

    // If a : b = p : q in small integers, then pixels (i, j) with the same p i + q j are alike: compute each kind once.
    for (int q = 1; q <= 16; ++q) {
        const double p_exact = q * a / b;
        const int p = p_exact < film.height ? static_cast<int>(std::lround(p_exact)) : 0;
        if (p == 0 || std::abs(p_exact - p) > 1e-14 * p)
            continue;
        std::vector<double> kinds(static_cast<std::size_t>(p) * columns + static_cast<std::size_t>(q * film.height));
        executor(kinds.size(),
                 [&](std::size_t kind) { kinds[kind] = map.pixel(least + b / q * static_cast<double>(kind), a, b); });
        for (int j = 0; j < film.height; ++j)
            for (int i = 0; i < film.width; ++i)
                row(j)[i] = kinds[static_cast<std::size_t>(p * i + q * j)];
        return image;
    }

    executor(static_cast<std::size_t>(film.height), [&](std::size_t row_number) {
        const int j = static_cast<int>(row_number);
        for (int i = 0; i < film.width; ++i)
            row(j)[i] = map.pixel(2 * film.x(i) + film.y(j), a, b);
    });
    return image;
}

} // namespace nephroid::reference
