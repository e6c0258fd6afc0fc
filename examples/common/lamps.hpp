// SPDX-License-Identifier: MIT
/// @file  The lamps of a scene, as direct light knows them.
#pragma once

#include "common/environment.hpp"
#include "common/scene.hpp"

#include <array>
#include <cstddef>
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
    std::size_t part = 0, material = 0; ///< of the scene, that emit it
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

/// The area lamps of a scene: the triangles of its meshes that emit, one lamp for each material of each mesh.
///
/// They are moved in front of the triangles by more than rounding, so that neither photons that start there nor shadow
/// rays that end there hit the triangles. A triangle that emits on both sides is included twice.
template <class T, Flux F>
[[nodiscard]] std::vector<AreaLamp<T, F>> area_lamps(const Scene<T, F>& scene) {
    std::vector<AreaLamp<T, F>> lamps;
    for (std::size_t part = 0; part < scene.parts().size(); ++part) {
        const auto* mesh = std::get_if<TriangleMesh<T>>(&scene.parts()[part].shape);
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
                by_material[material].part = part;
                by_material[material].material = material;
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

} // namespace nephroid::examples
