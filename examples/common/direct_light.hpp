// SPDX-License-Identifier: MIT
/// @file  Direct light: from the lamps straight to diffuse surfaces.
#pragma once

#include "common/eye_paths.hpp"
#include "common/lamps.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace nephroid::examples {

struct DirectLightOptions {
    unsigned shadow_rays = 4;       ///< for each vertex and area lamp, > 0
    unsigned environment_rays = 32; ///< for each vertex and environment, > 0
    std::uint64_t seed = 0;
};

namespace detail {

/// An area lamp, ready to be sampled.
template <class T, Flux F>
class SampledAreaLamp {
public:
    explicit SampledAreaLamp(const AreaLamp<T, F>& lamp) : lamp_(&lamp) {
        for (const auto& [a, b, c] : lamp.triangles) {
            const Vec3<T> face = cross(b - a, c - a);
            area_ += 0.5 * double(length(face));
            area_up_to_.push_back(area_);
            normals_.push_back(normalize(face));
        }
    }

    struct Point {
        Vec3<T> position, normal;
    };

    /// @param u1,u2  0 to 1; the first chooses the triangle as well
    [[nodiscard]] Point point(double u1, T u2) const {
        const double place = u1 * area_;
        const auto found = std::upper_bound(area_up_to_.begin(), area_up_to_.end() - 1, place);
        const std::size_t i = static_cast<std::size_t>(found - area_up_to_.begin());
        const double before = i > 0 ? area_up_to_[i - 1] : 0;
        const T rest = T((std::clamp)((place - before) / (area_up_to_[i] - before), 0.0, 1.0));
        const auto& [a, b, c] = lamp_->triangles[i];
        const T root = std::sqrt(rest); // uniform in the triangle
        return {a + (root * (T(1) - u2)) * (b - a) + (root * u2) * (c - a), normals_[i]};
    }

    [[nodiscard]] T area() const { return T(area_); }
    [[nodiscard]] const F& radiance() const { return lamp_->radiance; }

private:
    const AreaLamp<T, F>* lamp_;
    double area_ = 0;
    std::vector<double> area_up_to_;
    std::vector<Vec3<T>> normals_;
};

} // namespace detail

/// The direct irradiance at points of diffuse surfaces. Specular surfaces block it like all others, because the light
/// through them belongs to the caustics.
template <class T, Flux F>
class DirectLight {
public:
    /// The scene, the lamps and the options are kept by reference, and must outlive this object.
    DirectLight(const Scene<T, F>& scene, const Lamps<T, F>& lamps, const DirectLightOptions& options)
        : scene_(scene), lamps_(lamps), options_(options) {
        for (const AreaLamp<T, F>& area : lamps.areas)
            areas_.emplace_back(area);
    }

    /// @param index  of the vertex; its random numbers depend on this
    [[nodiscard]] F irradiance(const EyeVertex<T, F>& vertex, std::uint64_t index) const {
        F sum = flux_traits<F>::zero();
        for (const Lamp<T, F>& lamp : lamps_.lamps)
            sum = sum + from_lamp(vertex, lamp);
        for (std::size_t i = 0; i < areas_.size(); ++i)
            sum = sum + from_area(vertex, areas_[i], hash_bits(hash_bits(options_.seed, i), index));
        for (std::size_t i = 0; i < lamps_.environments.size(); ++i)
            sum = sum + from_environment(vertex, *lamps_.environments[i],
                                         hash_bits(hash_bits(options_.seed, areas_.size() + i), index));
        return sum;
    }

private:
    [[nodiscard]] F from_lamp(const EyeVertex<T, F>& vertex, const Lamp<T, F>& lamp) const {
        const F nothing = flux_traits<F>::zero();
        if (lamp.kind == Lamp<T, F>::Kind::directional) {
            const T cos = cosine(vertex, -lamp.direction);
            const bool lit = cos > T(0) && !shadowed(vertex, -lamp.direction, std::numeric_limits<T>::infinity());
            return lit ? F(lamp.intensity * cos) : nothing;
        }
        const Vec3<T> to_lamp = lamp.position - vertex.position;
        const T distance2 = length2(to_lamp), distance = std::sqrt(distance2);
        if (!(distance > T(0)))
            return nothing;
        const Vec3<T> direction = T(1) / distance * to_lamp;
        T factor = cosine(vertex, direction) / distance2;
        if (lamp.kind == Lamp<T, F>::Kind::spot)
            factor *= lamp.falloff(-direction);
        return factor > T(0) && !shadowed(vertex, direction, distance) ? F(lamp.intensity * factor) : nothing;
    }

    /// One shadow ray to each of as many strata along the first coordinate; the second is spread by the golden ratio.
    [[nodiscard]] F from_area(const EyeVertex<T, F>& vertex, const detail::SampledAreaLamp<T, F>& lamp,
                              std::uint64_t seed) const {
        constexpr double golden_ratio = 0.6180339887498949;
        const double shift = uniform_from_bits<double>(hash_bits(seed, 0));
        T sum = T(0);
        for (unsigned k = 0; k < options_.shadow_rays; ++k) {
            const double u1 = (k + uniform_from_bits<double>(hash_bits(seed, k + 1))) / options_.shadow_rays;
            const double u2 = shift + k * golden_ratio;
            const auto point = lamp.point(u1, T(u2 - std::floor(u2)));
            const Vec3<T> to_lamp = point.position - vertex.position;
            const T distance2 = length2(to_lamp), distance = std::sqrt(distance2);
            if (!(distance > T(0)))
                continue;
            const Vec3<T> direction = T(1) / distance * to_lamp;
            const T cos_lamp = -dot(direction, point.normal);
            const T cos = cosine(vertex, direction);
            if (cos_lamp > T(0) && cos > T(0) && !shadowed(vertex, direction, distance))
                sum += cos * cos_lamp / distance2;
        }
        return lamp.radiance() * (sum * lamp.area() / T(options_.shadow_rays));
    }

    /// Draws half of the rays in proportion to the environment's light, half in proportion to the cosine, and weights
    /// them with both densities (the balance heuristic of Veach and Guibas 1995). A sun needs only the former, a
    /// constant environment only the latter.
    [[nodiscard]] F from_environment(const EyeVertex<T, F>& vertex, const Environment<T, F>& environment,
                                     std::uint64_t seed) const {
        constexpr double golden_ratio = 0.6180339887498949;
        const double by_light = environment.is_lamp() ? 1 : environment.is_constant() ? 0 : 0.5;
        const unsigned count = environment.is_lamp() ? options_.shadow_rays : options_.environment_rays;
        const double shift = uniform_from_bits<double>(hash_bits(seed, 0));
        const Frame<Vec3<T>> frame = frame_about(vertex.shading_normal);
        F sum = flux_traits<F>::zero();
        for (unsigned k = 0; k < count; ++k) {
            const double u1 = (k + uniform_from_bits<double>(hash_bits(seed, k + 1))) / count;
            const double next = shift + k * golden_ratio, u2 = next - std::floor(next);
            const Vec3<T> direction =
                u1 < by_light ? environment.sample(u1 / by_light, u2).towards
                              : cosine_direction(vertex.shading_normal, frame,
                                                 concentric_disk(T((u1 - by_light) / (1 - by_light)), T(u2)));
            const T cos = cosine(vertex, direction);
            if (!(cos > T(0)) || shadowed(vertex, direction, std::numeric_limits<T>::infinity()))
                continue;
            const double density = (by_light > 0 ? by_light * environment.density(direction) : 0) +
                                   (1 - by_light) * double(cos) / pi<double>;
            sum = sum + environment.radiance(direction) * grey<F>(double(cos) / (density * count));
        }
        return sum;
    }

    [[nodiscard]] static T cosine(const EyeVertex<T, F>& vertex, const Vec3<T>& to_lamp) {
        return dot(to_lamp, vertex.normal) > T(0) ? dot(to_lamp, vertex.shading_normal) : T(0);
    }

    [[nodiscard]] bool shadowed(const EyeVertex<T, F>& vertex, const Vec3<T>& direction, T distance) const {
        const Vec3<T> origin = vertex.position + T(2) * vertex.position_error * vertex.normal;
        return scene_.occluded(origin, direction, T(0), distance * (T(1) - T(4) * std::numeric_limits<T>::epsilon()));
    }

    const Scene<T, F>& scene_;
    const Lamps<T, F>& lamps_;
    DirectLightOptions options_;
    std::vector<detail::SampledAreaLamp<T, F>> areas_;
};

/// The direct layer of a picture: emitters as the pixels see them, and direct light that the vertices reflect.
///
/// @return  linear radiance by pixel, as long as `eye.emitted`
/// @param executor  the result does not depend on it
template <class T, Flux F, Executor E>
[[nodiscard]] std::vector<F> direct_layer(const Scene<T, F>& scene, const Lamps<T, F>& lamps, const EyePaths<T, F>& eye,
                                          const DirectLightOptions& options, E&& executor) {
    constexpr std::size_t chunk = 4096; // vertices
    const DirectLight<T, F> light(scene, lamps, options);
    std::vector<F> reflected(eye.vertices.size());
    executor((reflected.size() + chunk - 1) / chunk, [&](std::size_t part) {
        const std::size_t last = (std::min)((part + 1) * chunk, reflected.size());
        for (std::size_t i = part * chunk; i < last; ++i)
            reflected[i] =
                eye.vertices[i].weight * (light.irradiance(eye.vertices[i], i) * eye.vertices[i].diffuse_share);
    });
    std::vector<F> picture = eye.emitted;
    for (std::size_t i = 0; i < reflected.size(); ++i)
        picture[eye.vertices[i].pixel] = picture[eye.vertices[i].pixel] + reflected[i];
    return picture;
}

} // namespace nephroid::examples
