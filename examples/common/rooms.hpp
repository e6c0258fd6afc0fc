// SPDX-License-Identifier: MIT
/// @file  Rooms that are built in: closed, lit by a lamp, y up, for light that bounces.
#pragma once

#include "common/camera_from_gltf.hpp"
#include "common/lamps.hpp"
#include "common/rooms/mesh_faces.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nephroid::examples {

/// A scene with its lamps and a place to look from.
template <class T, Flux F>
struct Room {
    Scene<T, F> scene;
    Lamps<T, F> lamps; ///< the scene's surfaces that emit
    CameraDescription camera;

    Room(std::vector<typename Scene<T, F>::Part> parts, std::vector<Material<F>> materials)
        : scene(std::move(parts), std::move(materials)) {
        lamps.areas = area_lamps(scene);
    }
};

/// box: the unit cube with a red and a green wall and a lamp in its ceiling. cornell: the same with a ball of glass.
/// table: a room with a table, chairs, a lamp above and a ball of glass.
inline constexpr std::array<std::string_view, 3> room_names = {"box", "cornell", "table"};

[[nodiscard]] inline bool is_room(std::string_view name) {
    return std::find(room_names.begin(), room_names.end(), name) != room_names.end();
}

/// "box, cornell, table"
[[nodiscard]] inline std::string names_of_rooms() {
    std::string names;
    for (const std::string_view name : room_names)
        names += (names.empty() ? "" : ", ") + std::string(name);
    return names;
}

namespace detail {

/// Diffuse, and emits as well, so that light that falls on the lamp bounces.
template <Flux F>
[[nodiscard]] Material<F> lamp_of(double radiance, double albedo) {
    Material<F> material = Material<F>::diffuse(grey<F>(albedo));
    material.emission = grey<F>(radiance);
    return material;
}

template <class T, Flux F>
[[nodiscard]] Room<T, F> box_room(bool has_ball) {
    enum : std::uint32_t { white, red, green, lamp, glass };
    const double side = 0.3; // of the lamp, whose flux is 1 in each band
    std::vector<Material<F>> materials = {
        Material<F>::diffuse(grey<F>(0.73)), Material<F>::diffuse(color_from_rgb<F>({0.63f, 0.06f, 0.05f})),
        Material<F>::diffuse(color_from_rgb<F>({0.14f, 0.45f, 0.09f})),
        lamp_of<F>(1 / (pi<double> * square(side)), 0.73), Material<F>::dielectric(1.5)};
    MeshData<T> mesh;
    const T low = T(0.35), high = T(0.65);
    add_room(mesh, Box<T>{Vec3<T>(0), Vec3<T>(1)}, {red, green, white, white, white, white},
             Box<T>{Vec3<T>(low), Vec3<T>(high)}, lamp);
    std::vector<typename Scene<T, F>::Part> parts = {{TriangleMesh<T>(std::move(mesh)), white}};
    if (has_ball)
        parts.push_back({Sphere<T>({T(0.38), T(0.25), T(0.45)}, T(0.2)), glass});
    Room<T, F> room(std::move(parts), std::move(materials));
    room.camera.position = {0.5f, 0.5f, 0.98f};
    room.camera.yfov = 1.6f;
    return room;
}

/// The parts of a chair at the origin, its back towards +z, in metres.
template <class T>
void add_chair(MeshData<T>& mesh, const Vec3<T>& at, bool turned, std::uint32_t material) {
    const auto add = [&](double x0, double y0, double z0, double x1, double y1, double z1) {
        const T z = turned ? T(-1) : T(1);
        Box<T> box;
        box.add(at + Vec3<T>(T(x0), T(y0), z * T(z0)));
        box.add(at + Vec3<T>(T(x1), T(y1), z * T(z1)));
        add_block(mesh, box, material, y0 > 0);
    };
    for (const double x : {-0.2, 0.16})
        for (const double z : {-0.2, 0.16})
            add(x, 0, z, x + 0.04, 0.44, z + 0.04);
    add(-0.2, 0.44, -0.2, 0.2, 0.47, 0.2);
    add(-0.2, 0.47, 0.17, 0.2, 0.9, 0.2);
}

template <class T, Flux F>
[[nodiscard]] Room<T, F> table_room() {
    enum : std::uint32_t { white, wood, blue, lamp, glass };
    std::vector<Material<F>> materials = {Material<F>::diffuse(grey<F>(0.75)),
                                          Material<F>::diffuse(color_from_rgb<F>({0.5f, 0.33f, 0.18f})),
                                          Material<F>::diffuse(color_from_rgb<F>({0.15f, 0.25f, 0.55f})),
                                          lamp_of<F>(10, 0.75), Material<F>::dielectric(1.5)};
    MeshData<T> mesh;
    add_room(mesh, Box<T>{{0, 0, 0}, {4, T(2.5), 3}}, {blue, white, wood, white, white, white});
    const auto block = [&](double x0, double y0, double z0, double x1, double y1, double z1, std::uint32_t material) {
        add_block(mesh, Box<T>{{T(x0), T(y0), T(z0)}, {T(x1), T(y1), T(z1)}}, material, y0 > 0);
    };
    block(1.3, 0.7, 0.9, 2.7, 0.74, 1.7, wood); // the table
    for (const double x : {1.34, 2.6})
        for (const double z : {0.94, 1.6})
            block(x, 0, z, x + 0.06, 0.7, z + 0.06, wood);
    add_chair(mesh, Vec3<T>(T(1.6), 0, T(1.85)), false, wood);
    add_chair(mesh, Vec3<T>(T(2.3), 0, T(1.95)), false, blue);
    add_chair(mesh, Vec3<T>(T(2), 0, T(0.75)), true, wood);
    block(0.1, 0, 0.1, 0.5, 0.9, 0.8, white); // a cupboard
    // The lamp hangs above the table, and shines down.
    block(1.7, 1.72, 1.1, 2.3, 1.75, 1.5, white);
    const T y = T(1.71);
    add_face(mesh, Vec3<T>(T(1.7), y, T(1.1)), Vec3<T>(T(2.3), y, T(1.1)), Vec3<T>(T(2.3), y, T(1.5)),
             Vec3<T>(T(1.7), y, T(1.5)), lamp);
    Room<T, F> room(
        {{TriangleMesh<T>(std::move(mesh)), white}, {Sphere<T>({T(2.2), T(0.861), T(1.25)}, T(0.12)), glass}},
        std::move(materials));
    const glm::vec3 from(3.7f, 1.65f, 2.85f), to(1.9f, 0.75f, 1.2f);
    room.camera.position = from;
    room.camera.forward = normalize(to - from);
    room.camera.right = normalize(cross(room.camera.forward, glm::vec3(0, 1, 0)));
    room.camera.up = cross(room.camera.right, room.camera.forward);
    room.camera.yfov = 1.0f;
    return room;
}

} // namespace detail

/// @param name  one of `room_names`; for another name, nothing is returned
template <class T, Flux F = Vec3<T>>
[[nodiscard]] std::optional<Room<T, F>> built_in_room(std::string_view name) {
    if (name == "box" || name == "cornell")
        return detail::box_room<T, F>(name == "cornell");
    if (name == "table")
        return detail::table_room<T, F>();
    return std::nullopt;
}

} // namespace nephroid::examples
