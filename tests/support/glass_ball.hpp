// SPDX-License-Identifier: MIT
/// @file  A glass ball above a floor in any vector type and any scalar: a whole caustic, small enough for a test.
#pragma once

#include "nephroid/caustics.hpp"
#include "nephroid/emission/light/directional.hpp"
#include "nephroid/sequence/halton.hpp"

#include <optional>
#include <vector>

namespace nephroid::tests {

/// The ball of radius 1, its centre `height` above the floor z = 0. Uses nothing of a vector but its traits.
template <Vector3 V, Flux F>
struct GlassBall {
    using T = scalar_t<V>;
    using Hit = SurfaceHit<V, AnyCurvature<Flat, ShapeOperator<V>>>;

    T height{1.5};
    T index{1.5}; ///< of refraction
    F tint;       ///< of the glass: each refraction multiplies by it

    [[nodiscard]] std::optional<Hit> intersect(const V& origin, const V& direction, const T& t_min,
                                               const T& t_max) const {
        using t = vector_traits<V>;
        const V up = t::make(T(0), T(0), T(1));
        const V to_origin = origin - height * up;
        const T b = dot(to_origin, direction), root = b * b - (length2(to_origin) - T(1));
        if (root > T(0))
            for (const T& distance : {T(-b - sqrt(root)), T(-b + sqrt(root))})
                if (distance > t_min && distance < t_max) {
                    const V normal = normalize(V(to_origin + distance * direction)), at = height * up + normal;
                    return Hit{
                        distance, at, normal, normal, sphere_curvature<V>(T(1)), rounding_error(origin, distance, at),
                        1};
                }
        const T distance = -t::z(origin) / t::z(direction);
        if (!(distance > t_min && distance < t_max))
            return std::nullopt;
        const V at = origin + distance * direction;
        return Hit{distance, at, up, up, Flat{}, rounding_error(origin, distance, at), 0};
    }

    template <class Sampler>
    [[nodiscard]] Scattering<F, T> scatter(const Hit& hit, const V& direction, Sampler&) const {
        if (hit.surface == 0)
            return Scattering<F, T>::deposit();
        return Scattering<F, T>::refract(tint, dot(direction, hit.geometric_normal) < T(0) ? T(1) / index : index);
    }
};

template <Vector3 V>
struct FloorVertex {
    V position, normal;
};

template <class V>
using Floor = std::vector<FloorVertex<V>>;

/// rows × rows vertices over the caustic of a glass ball above the origin.
template <class V>
[[nodiscard]] Floor<V> floor_of(int rows, double reach = 0.8) {
    using T = scalar_t<V>;
    Floor<V> vertices;
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < rows; ++x)
            vertices.push_back(
                {make_vector<V>(T(reach * (2 * (x + 0.5) / rows - 1)), T(reach * (2 * (y + 0.5) / rows - 1)), T(0)),
                 make_vector<V>(T(0), T(0), T(1))});
    return vertices;
}

template <class V>
[[nodiscard]] EyePathMap<V> map_of(const Floor<V>& vertices) {
    return EyePathMap<V>(vertices, &FloorVertex<V>::position, &FloorVertex<V>::normal);
}

/// The irradiance at rows × rows vertices on the floor around the caustic, in slanting light of irradiance `sun`.
template <class Policies = Default, Vector3 V, Flux F>
[[nodiscard]] std::vector<F> caustic_of(const GlassBall<V, F>& scene, const F& sun, int rows = 16,
                                        std::uint64_t photons = 600) {
    using T = scalar_t<V>;
    using t = vector_traits<V>;
    std::vector<FloorVertex<V>> vertices;
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < rows; ++x)
            vertices.push_back({t::make(T(1.6 * (x + 0.5) / rows - 0.6), T(1.6 * (y + 0.5) / rows - 0.8), T(0)),
                                t::make(T(0), T(0), T(1))});
    const EyePathMap<V> map(vertices, &FloorVertex<V>::position, &FloorVertex<V>::normal);
    auto sums = nephroid::sums<F>(map);
    const DirectionalLight<V, F> light({.direction = t::make(T(0.25), T(0), T(-1)),
                                        .irradiance = sun,
                                        .patch = BoundingSphere<V>{t::make(T(0), T(0), T(1.5)), T(1.25)}});
    (void)caustics(scene, light, sums, {.count = photons, .smoothing = 6}, Policies{});
    std::vector<F> irradiance(vertices.size(), flux_traits<F>::zero());
    sums.for_each([&](std::size_t i, const F& e) { irradiance[i] = e; });
    return irradiance;
}

} // namespace nephroid::tests
