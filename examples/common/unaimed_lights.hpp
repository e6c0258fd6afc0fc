// SPDX-License-Identifier: MIT
/// @file  The lamps of a scene as lights that send photons everywhere, for light that bounces.
#pragma once

#include "common/photon_lights.hpp"

#include <utility>
#include <vector>

namespace nephroid::examples {

namespace detail {

/// @param around  the whole scene
template <class T, Flux F>
[[nodiscard]] typename SceneLights<T, F>::AnyLight unaimed(const Lamp<T, F>& lamp,
                                                           const BoundingSphere<Vec3<T>>& around) {
    using V = Vec3<T>;
    switch (lamp.kind) {
    case Lamp<T, F>::Kind::spot:
        return SpotLight<V, F>({.position = lamp.position,
                                .axis = lamp.direction,
                                .cos_inner = lamp.cos_inner,
                                .cos_outer = lamp.cos_outer,
                                .intensity = lamp.intensity});
    case Lamp<T, F>::Kind::directional:
        return DirectionalLight<V, F>(
            {.direction = lamp.direction, .irradiance = lamp.intensity, .patch = around, .scene = around});
    default:
        return PointLight<V, F>({.position = lamp.position, .intensity = lamp.intensity});
    }
}

} // namespace detail

/// All of the lamps' light that reaches a scene. Throws std::invalid_argument if there are no lamps, or nothing else.
template <class T, Flux F>
[[nodiscard]] SceneLights<T, F> unaimed_lights(const Lamps<T, F>& lamps, const Scene<T, F>& scene) {
    using V = Vec3<T>;
    if (lamps.empty())
        invalid_argument("the scene has no lights");
    if (scene.bounds().is_empty())
        invalid_argument("the scene has nothing to shine on");
    const std::array<V, 2> corners{scene.bounds().min, scene.bounds().max};
    const BoundingSphere<V> around = bounding_sphere(corners);
    std::vector<typename SceneLights<T, F>::AnyLight> lights;
    for (const Lamp<T, F>& lamp : lamps.lamps)
        lights.push_back(detail::unaimed(lamp, around));
    for (const AreaLamp<T, F>& lamp : lamps.areas)
        lights.push_back(MeshLight<V, F>({.triangles = lamp.triangles, .radiance = lamp.radiance}));
    for (const auto& environment : lamps.environments)
        lights.push_back(EnvironmentLight<T, F>(environment, around, around));
    return SceneLights<T, F>(std::move(lights));
}

} // namespace nephroid::examples
