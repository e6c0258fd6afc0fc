// SPDX-License-Identifier: MIT
/// @file  The lamps of a scene, for direct light and as emitters of photons towards specular surfaces.
#pragma once

#include "common/environment_light.hpp"
#include "common/scene.hpp"

#include "nephroid/emission/light/standard_lights.hpp"

#include <array>
#include <memory>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace nephroid::examples {

/// A lamp without area.
template <class T, Flux F>
struct Lamp {
    enum class Kind : unsigned char { point, spot, directional };

    Kind kind = Kind::point;
    Vec3<T> position{0};            ///< unused for a directional lamp
    Vec3<T> direction{0, 0, -1};    ///< of the light, unit; unused for a point lamp
    F intensity = grey<F>(1);       ///< W/sr; of a directional lamp the irradiance across the beam
    T cos_inner = 1, cos_outer = 0; ///< of a spot: full intensity within the inner angle, zero beyond the outer one

    /// The intensity in a unit direction away from a spot, over that on its axis.
    /// Source: glTF extension KHR_lights_punctual.
    [[nodiscard]] T falloff(const Vec3<T>& away) const {
        const T share = (dot(away, direction) - cos_outer) / (cos_inner - cos_outer);
        return square((std::clamp)(share, T(0), T(1)));
    }
};

/// A surface that emits light.
template <class T, Flux F>
struct AreaLamp {
    using Triangle = std::array<Vec3<T>, 3>;

    std::vector<Triangle> triangles; ///< counter-clockwise seen from the side that emits
    F radiance;
};

template <class T, Flux F>
struct Lamps {
    std::vector<Lamp<T, F>> lamps;
    std::vector<AreaLamp<T, F>> areas;
    std::vector<std::shared_ptr<const Environment<T, F>>> environments{};

    [[nodiscard]] bool empty() const { return lamps.empty() && areas.empty() && environments.empty(); }

    /// The radiance of a ray that leaves the scene.
    [[nodiscard]] F background(const Vec3<T>& direction) const {
        F sum = flux_traits<F>::zero();
        for (const auto& environment : environments)
            if (!environment->is_lamp())
                sum = sum + environment->radiance(direction);
        return sum;
    }
};

/// A scene's lamps as a light that emits photons.
template <class T, Flux F>
using SceneLights = LightSet<PointLight<Vec3<T>, F>, SpotLight<Vec3<T>, F>, DirectionalLight<Vec3<T>, F>,
                             MeshLight<Vec3<T>, F>, EnvironmentLight<T, F>>;

/// The area lamps of a scene: the triangles of its meshes that emit, one lamp for each material of each mesh.
///
/// They are moved in front of the triangles by more than rounding, so that neither photons that start there nor shadow
/// rays that end there hit the triangles. A triangle that emits on both sides is included twice.
template <class T, Flux F>
[[nodiscard]] std::vector<AreaLamp<T, F>> area_lamps(const Scene<T, F>& scene) {
    std::vector<AreaLamp<T, F>> lamps;
    for (const auto& part : scene.parts()) {
        const auto* mesh = std::get_if<TriangleMesh<T>>(&part.shape);
        if (!mesh)
            continue;
        std::vector<AreaLamp<T, F>> by_material(scene.materials().size());
        for (std::size_t i = 0; i < mesh->data().triangles.size(); ++i) {
            const std::uint32_t material = mesh->material(i);
            if (!scene.materials()[material].emits())
                continue;
            const auto [a, b, c] = mesh->corners(i);
            const Vec3<T> face = cross(b - a, c - a);
            if (!(length2(face) > T(0)))
                continue;
            const T off = T(8) * position_error(Vec3<T>(T(magnitude(a)), T(magnitude(b)), T(magnitude(c))), 0);
            const Vec3<T> lift = off * normalize(face);
            auto& triangles = by_material[material].triangles;
            triangles.push_back({a + lift, b + lift, c + lift});
            if (scene.materials()[material].emits_on_both_sides)
                triangles.push_back({a - lift, c - lift, b - lift});
        }
        for (std::size_t material = 0; material < by_material.size(); ++material)
            if (!by_material[material].triangles.empty()) {
                by_material[material].radiance = scene.materials()[material].emission;
                lamps.push_back(std::move(by_material[material]));
            }
    }
    return lamps;
}

/// Lets the photons of lamps under water or in glass start in these media.
template <class T, Flux F>
void begin_in_media(Scene<T, F>& scene, const Lamps<T, F>& lamps) {
    for (const Lamp<T, F>& lamp : lamps.lamps)
        if (lamp.kind != Lamp<T, F>::Kind::directional)
            scene.begin_in_media({lamp.position, lamp.position}, lamp.position);
    for (const AreaLamp<T, F>& lamp : lamps.areas) {
        Box<T> box;
        for (const auto& triangle : lamp.triangles)
            for (const Vec3<T>& corner : triangle)
                box.add(corner);
        const auto& [a, b, c] = lamp.triangles.front();
        scene.begin_in_media(box, T(1) / T(3) * (a + b + c));
    }
}

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
} // namespace detail

/// The lamps as lights that send photons to the scene's specular surfaces.
/// Throws std::invalid_argument if there are no lamps or no (bounded) specular surfaces.
template <class T, Flux F>
[[nodiscard]] SceneLights<T, F> photon_lights(const Lamps<T, F>& lamps, const Scene<T, F>& scene) {
    using V = Vec3<T>;
    if (lamps.empty())
        invalid_argument("the scene has no lights");
    const auto target = scene.specular_bounds();
    if (!target)
        invalid_argument("the scene has no specular surfaces: nothing in it makes a caustic");

    std::vector<typename SceneLights<T, F>::AnyLight> lights;
    for (const Lamp<T, F>& lamp : lamps.lamps) {
        switch (lamp.kind) {
        case Lamp<T, F>::Kind::point:
            lights.push_back(
                PointLight<V, F>({.position = lamp.position, .intensity = lamp.intensity, .target = target}));
            break;
        case Lamp<T, F>::Kind::spot:
            lights.push_back(SpotLight<V, F>({.position = lamp.position,
                                              .axis = lamp.direction,
                                              .cos_inner = lamp.cos_inner,
                                              .cos_outer = lamp.cos_outer,
                                              .intensity = lamp.intensity,
                                              .target = target}));
            break;
        case Lamp<T, F>::Kind::directional: {
            const auto patch = smallest_beam_over(lamp.direction, scene.specular_points());
            lights.push_back(
                DirectionalLight<V, F>({.direction = lamp.direction,
                                        .irradiance = lamp.intensity,
                                        .patch = detail::in_front_of<T>(patch, lamp.direction, scene.bounds())}));
            break;
        }
        }
    }
    for (const AreaLamp<T, F>& area : lamps.areas) {
        const auto triangles = detail::facing<T>(area.triangles, *target);
        if (!triangles.empty())
            lights.push_back(MeshLight<V, F>({.triangles = triangles, .radiance = area.radiance, .target = target}));
    }
    for (const auto& environment : lamps.environments) {
        const Box<T>& bounds = scene.bounds();
        lights.push_back(EnvironmentLight<T, F>(
            environment, *target,
            {T(0.5) * (bounds.min + bounds.max), T(0.5) * length(Vec3<T>(bounds.max - bounds.min))}));
    }
    if (lights.empty())
        invalid_argument("no light of the scene shines towards its specular surfaces");
    return SceneLights<T, F>(std::move(lights));
}

} // namespace nephroid::examples
