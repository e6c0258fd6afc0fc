// SPDX-License-Identifier: MIT
/// @file  The lamps of a scene as lights that send photons towards its specular surfaces.
#pragma once

#include "common/environment_light.hpp"
#include "common/lamps.hpp"
#include "common/specular_objects.hpp"

#include "nephroid/emission/light/standard_lights.hpp"
#include "nephroid/emission/separate_targets.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

namespace nephroid::examples {

/// A scene's lamps as a light that emits photons.
template <class T, Flux F>
using SceneLights = LightSet<PointLight<Vec3<T>, F>, SpotLight<Vec3<T>, F>, DirectionalLight<Vec3<T>, F>,
                             MeshLight<Vec3<T>, F>, EnvironmentLight<T, F>>;

namespace detail {
/// A beam's patch, moved against the beam until it is in front of a whole box, so that objects between the lamp and the
/// specular surfaces cast shadows.
template <class T>
[[nodiscard]] BeamPatch<Vec3<T>> in_front_of(BeamPatch<Vec3<T>> patch, const Vec3<T>& direction, const Box<T>& box) {
    T nearest = std::numeric_limits<T>::infinity();
    for (int i = 0; i < 8; ++i)
        nearest = (std::min)(nearest, dot(box.corner(i), direction));
    const T size = length(box.max - box.min);
    const auto move = [&](Vec3<T>& origin) {
        const T back = dot(origin, direction) - nearest + size / T(64);
        if (back > T(0))
            origin = origin - back * direction;
    };
    if (auto* disk = std::get_if<BeamDisk<Vec3<T>>>(&patch))
        move(disk->centre);
    if (auto* parallelogram = std::get_if<Parallelogram<Vec3<T>>>(&patch))
        move(parallelogram->corner); // perpendicular to the beam, so any corner will do
    return patch;
}

/// The triangles that see a part of the target. Photons of the others would carry no flux.
template <class T>
[[nodiscard]] std::vector<std::array<Vec3<T>, 3>> facing(std::vector<std::array<Vec3<T>, 3>> triangles,
                                                         const BoundingSphere<Vec3<T>>& target) {
    std::erase_if(triangles, [&](const std::array<Vec3<T>, 3>& t) {
        const Vec3<T> normal = normalize(cross(t[1] - t[0], t[2] - t[0]));
        return dot(target.centre - t[0], normal) <= -target.radius;
    });
    return triangles;
}
template <class T>
[[nodiscard]] T area_of(const BeamPatch<Vec3<T>>& patch) {
    if (const auto* sides = std::get_if<Parallelogram<Vec3<T>>>(&patch))
        return length(cross(sides->edge_u, sides->edge_v));
    const auto* disk = std::get_if<BeamDisk<Vec3<T>>>(&patch);
    return pi<T> * square(disk ? disk->radius : std::get<BoundingSphere<Vec3<T>>>(patch).radius);
}

/// A sphere around an area lamp.
template <class T, Flux F>
[[nodiscard]] BoundingSphere<Vec3<T>> bounds_of(const AreaLamp<T, F>& lamp) {
    std::vector<Vec3<T>> points;
    for (const auto& triangle : lamp.triangles)
        points.insert(points.end(), triangle.begin(), triangle.end());
    return bounding_sphere(points);
}

/// Makes the lights of one lamp after another, each aimed at the groups of specular objects that it sees apart.
template <class T, Flux F>
class PhotonLights {
    using V = Vec3<T>;
    using Groups = std::vector<TargetGroup<V>>;

public:
    explicit PhotonLights(const Scene<T, F>& scene)
        : scene_(scene), objects_(specular_objects(scene)), groups_(group_targets(objects_.bounds)) {
        for (TargetGroup<V>& group : groups_) { // the sphere around triangles is wider than that around their corners
            const auto by_points = bounding_sphere(objects_.points(scene, group.objects));
            if (by_points.radius < group.bounds.radius)
                group.bounds = by_points;
        }
    }

    void add(const Lamp<T, F>& lamp) {
        switch (lamp.kind) {
        case Lamp<T, F>::Kind::point:
            for (const auto& target : targets_from(lamp.position, groups_))
                lights_.push_back(PointLight<V, F>(
                    {.position = lamp.position, .intensity = lamp.intensity, .target = target.bounds}));
            break;
        case Lamp<T, F>::Kind::spot:
            for (const auto& target : targets_from(lamp.position, groups_, lamp.cos_outer))
                lights_.push_back(SpotLight<V, F>({.position = lamp.position,
                                                   .axis = lamp.direction,
                                                   .cos_inner = lamp.cos_inner,
                                                   .cos_outer = lamp.cos_outer,
                                                   .intensity = lamp.intensity,
                                                   .target = target.bounds}));
            break;
        case Lamp<T, F>::Kind::directional:
            for (const auto& target : targets_across(objects_.bounds, lamp.direction, groups_)) {
                const std::vector<V> points = objects_.points(scene_, target.objects);
                // Corners of a ball's box lie outside of the target's bounds. A patch over them may reach the next one.
                const bool reaches_out = std::any_of(points.begin(), points.end(), [&](const V& p) {
                    return length(p - target.bounds.centre) > target.bounds.radius;
                });
                auto patch = smallest_beam_over(lamp.direction, points);
                if (reaches_out || pi<T> * square(target.bounds.radius) < area_of<T>(patch))
                    patch = beam_over(lamp.direction, target.bounds);
                lights_.push_back(
                    DirectionalLight<V, F>({.direction = lamp.direction,
                                            .irradiance = lamp.intensity,
                                            .patch = in_front_of<T>(patch, lamp.direction, scene_.bounds())}));
            }
            break;
        }
    }

    void add(const AreaLamp<T, F>& lamp) {
        for (const auto& target : targets_from_area(objects_.bounds, bounds_of(lamp), groups_)) {
            const auto triangles = facing<T>(lamp.triangles, target.bounds);
            if (!triangles.empty())
                lights_.push_back(
                    MeshLight<V, F>({.triangles = triangles, .radiance = lamp.radiance, .target = target.bounds}));
        }
    }

    void add(const std::shared_ptr<const Environment<T, F>>& environment) {
        const Box<T>& bounds = scene_.bounds();
        std::vector<BoundingSphere<V>> before;
        for (const TargetGroup<V>& group : groups_) {
            lights_.push_back(EnvironmentLight<T, F>(
                environment, group.bounds,
                {T(0.5) * (bounds.min + bounds.max), T(0.5) * length(V(bounds.max - bounds.min))}, before));
            before.push_back(group.bounds);
        }
    }

    [[nodiscard]] std::vector<typename SceneLights<T, F>::AnyLight> take() { return std::move(lights_); }

private:
    const Scene<T, F>& scene_;
    SpecularObjects<T> objects_;
    Groups groups_;
    std::vector<typename SceneLights<T, F>::AnyLight> lights_;
};
} // namespace detail

/// The lamps as lights that send photons to the scene's specular surfaces.
/// Throws std::invalid_argument if there are no lamps or no (bounded) specular surfaces.
template <class T, Flux F>
[[nodiscard]] SceneLights<T, F> photon_lights(const Lamps<T, F>& lamps, const Scene<T, F>& scene) {
    if (lamps.empty())
        invalid_argument("the scene has no lights");
    if (!scene.specular_bounds())
        invalid_argument("the scene has no specular surfaces: nothing in it makes a caustic");
    detail::PhotonLights<T, F> made(scene);
    for (const auto& lamp : lamps.lamps)
        made.add(lamp);
    for (const auto& area : lamps.areas)
        made.add(area);
    for (const auto& environment : lamps.environments)
        made.add(environment);
    auto lights = made.take();
    if (lights.empty())
        invalid_argument("no light of the scene shines towards its specular surfaces");
    return SceneLights<T, F>(std::move(lights));
}

} // namespace nephroid::examples
