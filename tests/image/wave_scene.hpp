// SPDX-License-Identifier: MIT
/// @file  Water over a floor whose hits know a distance, its error and a normal: no curvature, no ids.
#pragma once

#include "nephroid/emission/light/directional.hpp"
#include "nephroid/transport/scattering.hpp"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <optional>

namespace nephroid::tests {

template <class T>
struct PlainWave {
    using Vec3 = glm::vec<3, T>;
    static constexpr bool scatters_by_chance = false;
    static constexpr double index = 1.33;

    struct PlainHit {
        T distance;
        Vec3 geometric_normal;
        T position_error;
        bool is_water;
    };

    T amplitude = T(0.04);

    /// Light comes straight down, so above the floor the first crossing from above is at the ray's own x and y.
    [[nodiscard]] std::optional<PlainHit> intersect(const Vec3& o, const Vec3& d, T t_min, T t_max) const {
        const auto phase = [](const Vec3& p) { return T(2 * 3.14159265358979323846) * (2 * p.x + p.y); };
        if (d.x == 0 && d.y == 0 && d.z < 0) {
            const T t = o.z - (1 + amplitude * std::sin(phase(o)));
            const T slope = amplitude * T(2 * 3.14159265358979323846) * std::cos(phase(o));
            if (t > t_min && t < t_max)
                return PlainHit{t, glm::normalize(Vec3(-2 * slope, -slope, 1)), T(1e-6), true};
        }
        const T t = -o.z / d.z;
        if (d.z < 0 && t > t_min && t < t_max)
            return PlainHit{t, {0, 0, 1}, T(1e-6), false};
        return std::nullopt;
    }

    [[nodiscard]] Scattering<T, T> scatter(const PlainHit& hit, const Vec3&, auto&) const {
        return hit.is_water ? Scattering<T, T>::refract(1, T(1 / index)) : Scattering<T, T>::deposit();
    }
};

/// Over the unit square, 1 on the ground.
template <class T>
[[nodiscard]] DirectionalLight<glm::vec<3, T>, T> sun_over_square() {
    return DirectionalLight<glm::vec<3, T>, T>(
        {.direction = {0, 0, -1},
         .irradiance = 1,
         .patch = Parallelogram<glm::vec<3, T>>{{0, 0, T(1.25)}, {1, 0, 0}, {0, 1, 0}}});
}

/// Where light that falls on the water at (x, y) lands, by Snell's law written out.
[[nodiscard]] inline glm::dvec2 landing(double x, double y, double amplitude) {
    const double two_pi = 2 * 3.14159265358979323846, phase = two_pi * (2 * x + y);
    const double slope = std::sqrt(5.0) * amplitude * two_pi * std::cos(phase);
    const double in = std::atan(slope), out = std::asin(std::sin(in) / PlainWave<double>::index);
    const double reach = (1 + amplitude * std::sin(phase)) * std::tan(in - out);
    return {x + reach * 2 / std::sqrt(5.0), y + reach / std::sqrt(5.0)};
}

} // namespace nephroid::tests
