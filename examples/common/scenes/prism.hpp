// SPDX-License-Identifier: MIT
/// @file  A prism behind a slit in the sun, and a screen: figure 12 of Frisvad et al. 2014.
#pragma once

#include "common/scenes/placing.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

namespace nephroid::examples::detail {

/// The prism stands at minimum deviation for yellow light that comes down at 73°.
template <class T, Flux F>
[[nodiscard]] Room<T, F> prism_scene() {
    enum : std::uint32_t { white, flint, black };
    Material<F> glass = Material<F>::dielectric(1.785);
    glass.dispersion = 20 / 25.7;
    const double down = -73 * std::numbers::pi / 180;
    const double deviation = 2 * std::asin(1.785 / 2) - std::numbers::pi / 3, within = down + deviation / 2;
    const Vec3<double> beam(std::cos(down), std::sin(down), 0), across(-std::sin(down), std::cos(down), 0);
    const Vec3<double> along(std::cos(within), std::sin(within), 0), towards_base(-along.y, along.x, 0);
    const Vec3<double> middle(0, 0.9, 0), z(0, 0, 1);
    const double height = std::sqrt(0.75);
    const Vec3<double> apex = middle - 2 * height / 3 * towards_base;
    const Vec3<double> entry = middle + height / 3 * towards_base - 0.5 * along, exit = entry + along;

    MeshData<T> mesh;
    add_ground(mesh, 8, white);
    const auto face = [&](const Vec3<double>& a, const Vec3<double>& b, double low, double high,
                          std::uint32_t material) {
        add_face<T>(mesh, Vec3<T>(a + low * z), Vec3<T>(a + high * z), Vec3<T>(b + high * z), Vec3<T>(b + low * z),
                    material);
    };
    for (const auto& [a, b] : {std::pair(apex, exit), std::pair(exit, entry), std::pair(entry, apex)})
        face(b, a, -1, 1, flint);
    for (const double end : {-1., 1.}) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (const Vec3<double>& corner : {apex, exit, entry})
            mesh.positions.push_back(Vec3<T>(corner + end * z));
        mesh.triangles.push_back(end > 0 ? std::array{first, first + 1, first + 2}
                                         : std::array{first, first + 2, first + 1});
        mesh.materials.push_back(flint);
    }
    // Two black plates leave a slit before the middle of the first face.
    const Vec3<double> slit = 0.5 * (apex + entry) - 1.2 * beam;
    face(slit - 2. * across, slit - 0.04 * across, -3, 3, black);
    face(slit + 0.04 * across, slit + 5. * across, -3, 3, black);
    face({4, 1.6, 0}, {4, 0, 0}, -2, 2, white); // the screen
    Room<T, F> room({{TriangleMesh<T>(std::move(mesh)), white}},
                    {Material<F>::diffuse(grey<F>(0.9)), glass, Material<F>::black()});
    Lamp<T, F> sun;
    sun.kind = Lamp<T, F>::Kind::directional;
    sun.direction = Vec3<T>(beam);
    room.lamps.lamps.push_back(sun);
    look(room.camera, {-1.2f, 1.8f, 5.2f}, {2.2f, 0.7f, 0}, 0.7f);
    return room;
}

} // namespace nephroid::examples::detail
