// SPDX-License-Identifier: MIT
/// @file  Two crossed waves on a liquid that disperses, above a floor: the scene of `study spectrum`.
#pragma once

#include "common/shapes/wave_field.hpp"

#include "nephroid/differential/curvature.hpp"
#include "nephroid/emission/light/directional.hpp"
#include "nephroid/emission/spectrum/spectral.hpp"
#include "nephroid/receiver/eye_path_map.hpp"
#include "nephroid/transport/scattering.hpp"
#include "nephroid/vector/glm.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <vector>

namespace nephroid::examples::study::spectrum {

inline constexpr std::size_t bands = 16;
using Color = Bands<float, bands>;
using V = glm::vec3;

/// Cauchy's index A + B/λ², λ in nanometres.
struct Glass {
    double a, b;
    [[nodiscard]] double index(double wavelength) const { return a + b / (wavelength * wavelength); }
    [[nodiscard]] double slope(double wavelength) const { return -2 * b / (wavelength * wavelength * wavelength); }
};

/// The liquid and the floor z = 0 below it. Rays come from above.
struct Water {
    using Hit = SurfaceHit<V, ParametricCurvature<V>>;

    WaveField surface{1, {{0.012, 2, 1}, {0.0096, -1, 2}}};
    Glass glass{1.73869, 15989}; // as SF11

    [[nodiscard]] std::optional<Hit> intersect(const V& o, const V& d, float t_min, float t_max) const {
        const Vec3<double> origin(o), direction(d);
        const double below = origin.z - surface.at(origin.x, origin.y).z;
        if (below > 0) {
            const auto t = surface.crossing(origin, direction, t_min, t_max);
            return t ? std::optional(on_surface(o, d, *t)) : std::nullopt;
        }
        const float t = -o.z / d.z;
        if (!(t > t_min && t < t_max))
            return std::nullopt;
        const V at(o.x + t * d.x, o.y + t * d.y, 0), up(0, 0, 1), zero(0);
        return Hit{t, at, up, up, {V(1, 0, 0), V(0, 1, 0), zero, zero}, rounding_error(o, t, at), 0};
    }

    struct Answer {
        Event event;
        float weight;
        float eta, d_eta;
    };
    /// Without Fresnel terms: all light is refracted.
    template <class Sampler, class Light>
    [[nodiscard]] Answer scatter(const Hit& hit, const V&, Sampler&, const Light& light) const {
        const double n = glass.index(light.wavelength);
        return {hit.surface == 0 ? Event::deposit : Event::refract, 1, float(1 / n),
                float(-glass.slope(light.wavelength) / (n * n))};
    }

private:
    [[nodiscard]] Hit on_surface(const V& o, const V& d, double t) const {
        const Vec3<double> p = Vec3<double>(o) + t * Vec3<double>(d);
        const WaveField::Relief w = surface.at(p.x, p.y);
        const double norm = std::sqrt(1 + w.z_x * w.z_x + w.z_y * w.z_y);
        const Vec3<double> n = Vec3<double>(-w.z_x, -w.z_y, 1) / norm;
        const auto change = [&](double x, double y) { // of the normal, with these changes of the slopes
            const Vec3<double> g(-x / norm, -y / norm, 0);
            return V(g - dot(g, n) * n);
        };
        const V at(float(p.x), float(p.y), float(w.z)), normal(n);
        return {float(t),
                at,
                normal,
                normal,
                {V(1, 0, float(w.z_x)), V(0, 1, float(w.z_y)), change(w.z_xx, w.z_xy), change(w.z_xy, w.z_yy)},
                rounding_error(o, float(t), at),
                1};
    }
};

/// The same for one wavelength.
struct WaterAt : Water {
    double wavelength;

    template <class Sampler>
    [[nodiscard]] Scattering<float, float> scatter(const Hit& hit, const V&, Sampler&) const {
        if (hit.surface == 0)
            return Scattering<float, float>::deposit();
        return Scattering<float, float>::refract(1, float(1 / glass.index(wavelength)));
    }
    static constexpr bool scatters_by_chance = false;
};

/// Sunlight at 50° from the zenith that lights the unit square of the floor and some more around it.
template <class F>
[[nodiscard]] DirectionalLight<V, F> sun(const F& irradiance_on_horizontals) {
    constexpr double zenith = 50 * std::numbers::pi / 180, azimuth = std::numbers::pi / 6, margin = 0.2;
    const double start = 1.03, in_water = std::tan(std::asin(std::sin(zenith) / 1.785));
    const double before = in_water + (start - 1) * std::tan(zenith); // how far light moves, from there to the floor
    const V corner(float(-margin - before * std::cos(azimuth)), float(-margin - before * std::sin(azimuth)),
                   float(start));
    const float side = float(1 + 2 * margin);
    return DirectionalLight<V, F>(
        {.direction = V(float(std::sin(zenith) * std::cos(azimuth)), float(std::sin(zenith) * std::sin(azimuth)),
                        float(-std::cos(zenith))),
         .irradiance = irradiance_on_horizontals * float(1 / std::cos(zenith)),
         .patch = Parallelogram<V>{corner, V(side, 0, 0), V(0, side, 0)}});
}

struct Pixel {
    V position, normal;
};

/// The pixels of the unit square of the floor.
[[nodiscard]] inline std::vector<Pixel> pixels_of(std::size_t size) {
    std::vector<Pixel> pixels;
    for (std::size_t i = 0; i < size * size; ++i)
        pixels.push_back(
            {V((float(i % size) + 0.5f) / float(size), (float(i / size) + 0.5f) / float(size), 0), V(0, 0, 1)});
    return pixels;
}

/// By pixel and band.
using Picture = std::vector<Color>;

} // namespace nephroid::examples::study::spectrum
