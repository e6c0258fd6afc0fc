// SPDX-License-Identifier: MIT
/// @file  A sine wave on water: a height field. A ray may cross it many times; the first crossing counts.
#pragma once

#include "common/ray.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace nephroid::examples {

/// The surface z = height + amplitude sin(2π (kx x + ky y)), over a rectangle or without end. Its normal points up.
template <class T>
class SineWave {
    using wide = wide_t<T>;
    using WideVec3 = Vec3<wide>;

public:
    struct Options {
        T height = 1;     ///< world units
        T amplitude = 0;  ///< world units, >= 0
        T kx = 2, ky = 1; ///< waves per unit length along x and y
        T x_min = -std::numeric_limits<T>::infinity(), x_max = std::numeric_limits<T>::infinity();
        T y_min = -std::numeric_limits<T>::infinity(), y_max = std::numeric_limits<T>::infinity();
    };

    explicit SineWave(const Options& options) : o_(options) {}

    [[nodiscard]] Box<T> bounds() const {
        return Box<T>{{o_.x_min, o_.y_min, o_.height - o_.amplitude}, {o_.x_max, o_.y_max, o_.height + o_.amplitude}}
            .padded();
    }

    [[nodiscard]] std::optional<Candidate<T>> nearest(const Ray<T>& ray, wide t_max) const {
        const Interval t = within_rectangle(ray, t_max);
        if (!(t.from < t.to))
            return std::nullopt;
        const auto crossing = first_crossing(Vec3<double>(ray.origin), Vec3<double>(ray.direction), t);
        if (!crossing || !(*crossing > double(ray.t_min) && *crossing < double(t_max)))
            return std::nullopt;
        return Candidate<T>{with_derivatives(*crossing, ray)};
    }

    [[nodiscard]] Hit<T> hit(const Ray<T>& ray, const Candidate<T>& candidate) const {
        // The height is computed at the rounded x and y, so that their rounding does not matter.
        const WideVec3 flown = widen(ray.origin) + candidate.distance * widen(ray.direction);
        const wide x = rounded(flown.x), y = rounded(flown.y), k_x(o_.kx), k_y(o_.ky), a(o_.amplitude);
        const wide phase = two_pi * (k_x * x + k_y * y), slope = a * two_pi * cos(phase);
        const WideVec3 gradient(-slope * k_x, -slope * k_y, 1);
        const wide inverse = 1 / length(gradient);
        const WideVec3 n = inverse * gradient, k(k_x, k_y, 0);
        // dn = (I − n nᵀ) H dx / |gradient|, where the Hessian is H = a (2π)² sin(phase) k kᵀ.
        const WideVec3 turned = (a * square(two_pi) * sin(phase) * inverse) * (k - dot(n, k) * n);
        return make_hit<T>(candidate.distance, WideVec3(x, y, wide(o_.height) + a * sin(phase)), n,
                           make_shape_operator<T>(k_x * turned, k_y * turned, WideVec3(0)), abs(wide(o_.height)) + a);
    }

private:
    static constexpr double two_pi = 2 * pi<double>;

    /// Rounded to T. Through memory, as GCC 12 at -O2 vectorises conversions to float and back into none at all.
    [[nodiscard]] static wide rounded(const wide& x) {
        if constexpr (std::is_same_v<T, wide>) {
            return x;
        } else {
            const volatile T through_memory = T(x);
            return wide(through_memory);
        }
    }

    /// The distance to a crossing with its derivatives, for scalars that carry derivatives. Each step of Newton's
    /// method adds one order of derivatives; the value does not change.
    [[nodiscard]] wide with_derivatives(double crossing, const Ray<T>& ray) const {
        if constexpr (std::is_floating_point_v<T>) {
            return crossing;
        } else {
            wide t = crossing;
            for (int order = 0; order < 2; ++order) {
                const WideVec3 p = widen(ray.origin) + t * widen(ray.direction);
                const wide phase = two_pi * (wide(o_.kx) * p.x + wide(o_.ky) * p.y);
                const wide turns = two_pi * (wide(o_.kx) * ray.direction.x + wide(o_.ky) * ray.direction.y);
                const wide above = p.z - wide(o_.height) - wide(o_.amplitude) * sin(phase);
                t = t - above / (ray.direction.z - wide(o_.amplitude) * turns * cos(phase));
            }
            return t;
        }
    }

    struct Interval {
        double from, to;
    };

    [[nodiscard]] Interval within_rectangle(const Ray<T>& ray, const wide& t_max) const {
        Interval t{double(ray.t_min), double(t_max)};
        const auto clip = [&t](double origin, double direction, double low, double high) {
            const double a = (low - origin) / direction, b = (high - origin) / direction;
            if (direction != 0) {
                t.from = (std::max)(t.from, (std::min)(a, b));
                t.to = (std::min)(t.to, (std::max)(a, b));
            } else if (origin < low || origin > high) {
                t.to = t.from;
            }
        };
        clip(double(ray.origin.x), double(ray.direction.x), double(o_.x_min), double(o_.x_max));
        clip(double(ray.origin.y), double(ray.direction.y), double(o_.y_min), double(o_.y_max));
        return t;
    }

    /// The height above the surface along the ray is f(t) = c + g t − a sin(p + w t). Seen from the side that the ray
    /// starts on and in the direction in which the phase grows, f starts positive, a > 0 or the sine is shifted, w >=
    /// 0. Its minima lie at equal distances, and their values on a line: the first one below zero is found at once,
    /// however many waves the ray passes over, and f falls monotonically to it from the maximum before.
    [[nodiscard]] std::optional<double> first_crossing(const Vec3<double>& o, const Vec3<double>& d,
                                                       const Interval& t) const {
        const double a(o_.amplitude);
        double c = o.z - double(o_.height), g = d.z;
        double p = two_pi * (double(o_.kx) * o.x + double(o_.ky) * o.y);
        double w = two_pi * (double(o_.kx) * d.x + double(o_.ky) * d.y);
        const auto f = [&](double at) { return c + g * at - a * std::sin(p + w * at); };
        const auto slope = [&](double at) { return g - a * w * std::cos(p + w * at); };
        if (f(t.from) < 0) // from below: flip the vertical axis
            c = -c, g = -g, p = p + pi<double>;
        if (w < 0) // sin(x) = sin(π − x)
            w = -w, p = pi<double> - p;

        if (!(a * w > abs(g))) { // monotonic
            if (!(g < 0))
                return std::nullopt;
            const double below = (std::min)((c + a) / -g * (1 + 8 * std::numeric_limits<double>::epsilon()),
                                            t.to); // c + g t − a sin <= 0 from (c + a)/−g on
            return falling_root(f, slope, t.from, below);
        }

        const double to_minimum = std::acos(g / (a * w)); // of the phase, in (0, π): there f' = 0 and f'' > 0
        const double period = two_pi / w;
        double minimum = (to_minimum - p) / w;
        minimum += period * std::ceil((t.from - minimum) / period);
        if (!(f(minimum) < 0)) {
            if (!(g < 0))
                return std::nullopt;
            minimum += period * std::ceil(f(minimum) / (-g * period));
            if (!(f(minimum) < 0)) // by rounding
                minimum += period;
        }
        const double maximum = minimum - 2 * to_minimum / w;
        return falling_root(f, slope, (std::max)(t.from, maximum), (std::min)(t.to, minimum));
    }

    /// The root of a function that falls from f(a) >= 0; nothing if f(b) > 0. Newton's method, and bisection where a
    /// step leaves the bracket or does not halve it.
    template <class F, class D>
    [[nodiscard]] static std::optional<double> falling_root(const F& f, const D& slope, double a, double b) {
        if (!(a <= b) || !std::isfinite(b) || f(b) > 0)
            return std::nullopt;
        double x = a + (b - a) / 2, last_step = b - a;
        for (int i = 0; i < 128; ++i) {
            const double fx = f(x);
            (fx > 0 ? a : b) = x;
            double next = x - fx / slope(x);
            if (!(next > a && next < b) || abs(next - x) > last_step / 2)
                next = a + (b - a) / 2;
            last_step = abs(next - x);
            x = next;
            if (last_step <= 2 * std::numeric_limits<double>::epsilon() * abs(x))
                break;
        }
        return x;
    }

    Options o_;
};

} // namespace nephroid::examples
