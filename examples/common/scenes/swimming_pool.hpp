// SPDX-License-Identifier: MIT
/// @file  A swimming pool with waves: figure 11 of Frisvad et al. 2014.
#pragma once

#include "common/scenes/placing.hpp"
#include "common/shapes/wave_field.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

namespace nephroid::examples::detail {

/// The paper's waves: 24 of them, of lengths from 0.35 to 2.57.
[[nodiscard]] inline WaveField pool_waves(double height) {
    std::vector<WaveField::Wave> waves;
    for (int i = 0; i < 24; ++i) {
        const auto turns = [i](double step) { return 2 * std::numbers::pi * (step * i - std::floor(step * i)); };
        const double length = 0.35 * std::pow(2, i / 8.0), angle = turns(0.6180339887);
        waves.push_back({0.0035 * length, std::cos(angle) / length, std::sin(angle) / length, turns(0.7548776662)});
    }
    return {height, std::move(waves)};
}

/// A basin of 10 × 5 m, 2 m deep, with tiles, and the sun at 50° over it.
template <class T, Flux F>
[[nodiscard]] Room<T, F> swimming_pool_scene() {
    enum : std::uint32_t { light, dark, rim, water };
    Material<F> liquid = Material<F>::dielectric(1.33);
    liquid.dispersion = 20.0 / 55;
    liquid.absorption = color_from_rgb<F>({0.30f, 0.07f, 0.02f});
    constexpr double tile = 0.25;
    MeshData<T> basin;
    const auto tiles = [&](const Vec3<double>& corner, const Vec3<double>& u, int columns, const Vec3<double>& v,
                           int rows) {
        for (int i = 0; i < columns; ++i)
            for (int j = 0; j < rows; ++j) {
                const Vec3<double> a = corner + double(i) * u + double(j) * v;
                add_face<T>(basin, Vec3<T>(a), Vec3<T>(a + u), Vec3<T>(a + u + v), Vec3<T>(a + v),
                            (i + j) % 2 == 0 ? light : dark);
            }
    };
    const Vec3<double> x(tile, 0, 0), y(0, tile, 0), z(0, 0, tile);
    const double top = 2.25; // of the walls; the water is 2 deep
    tiles({0, 0, 0}, z, 20, x, 40);
    tiles({0, 0, 0}, x, 40, y, 9);
    tiles({10, 0, 5}, -x, 40, y, 9);
    tiles({0, 0, 5}, -z, 20, y, 9);
    tiles({10, 0, 0}, z, 20, y, 9);
    for (const auto& [a, b] : {std::pair(Vec3<double>(-2, top, -2), Vec3<double>(12, top, 0)),
                               std::pair(Vec3<double>(-2, top, 5), Vec3<double>(12, top, 7)),
                               std::pair(Vec3<double>(-2, top, 0), Vec3<double>(0, top, 5)),
                               std::pair(Vec3<double>(10, top, 0), Vec3<double>(12, top, 5))})
        add_face<T>(basin, Vec3<T>(a), Vec3<T>(Vec3<double>(a.x, top, b.z)), Vec3<T>(b),
                    Vec3<T>(Vec3<double>(b.x, top, a.z)), rim);

    MeshData<T> surface;
    const WaveField waves = pool_waves(2);
    constexpr std::uint32_t columns = 512, rows = 256;
    for (std::uint32_t j = 0; j <= rows; ++j)
        for (std::uint32_t i = 0; i <= columns; ++i) {
            const double at_x = 10.0 * i / columns, at_z = 5.0 * j / rows;
            const WaveField::Relief relief = waves.at(at_x, at_z);
            surface.positions.push_back({T(at_x), T(relief.z), T(at_z)});
            surface.normals.push_back({T(-relief.z_x), T(1), T(-relief.z_y)});
            if (i == columns || j == rows)
                continue;
            const std::uint32_t a = j * (columns + 1) + i, b = a + columns + 1;
            surface.triangles.push_back({a, b, b + 1});
            surface.triangles.push_back({a, b + 1, a + 1});
            surface.materials.insert(surface.materials.end(), 2, water);
        }
    Room<T, F> room({{TriangleMesh<T>(std::move(basin)), light}, {TriangleMesh<T>(std::move(surface)), water}},
                    {Material<F>::diffuse(grey<F>(0.75)), Material<F>::diffuse(grey<F>(0.7)),
                     Material<F>::diffuse(color_from_rgb<F>({0.6f, 0.55f, 0.5f})), liquid});
    const double elevation = 50 * std::numbers::pi / 180, azimuth = 30 * std::numbers::pi / 180;
    Lamp<T, F> sun;
    sun.kind = Lamp<T, F>::Kind::directional;
    sun.direction = -Vec3<T>(T(std::cos(elevation) * std::cos(azimuth)), T(std::sin(elevation)),
                             T(std::cos(elevation) * std::sin(azimuth)));
    room.lamps.lamps.push_back(sun);
    look(room.camera, {-1.5f, 5.2f, 2.5f}, {4.5f, 0.8f, 2.5f}, 0.75f);
    return room;
}

} // namespace nephroid::examples::detail
