// SPDX-License-Identifier: MIT
/// @file  A glTF file's description as a scene with lamps.
#pragma once

#include "common/camera_from_gltf.hpp"
#include "common/gltf.hpp"
#include "common/lamps.hpp"
#include "common/materials_from_gltf.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace nephroid::examples {

template <class T, Flux F = Vec3<T>>
struct GltfScene {
    Scene<T, F> scene;
    Lamps<T, F> lamps;
    std::vector<std::string> warnings; ///< one line for each thing that is shown differently from the file
};

namespace detail {

template <class T, Flux F>
[[nodiscard]] Lamp<T, F> lamp_from(const LightDescription& light) {
    Lamp<T, F> lamp;
    using Kind = typename Lamp<T, F>::Kind;
    lamp.kind = light.kind == LightDescription::Kind::directional ? Kind::directional
                : light.kind == LightDescription::Kind::spot      ? Kind::spot
                                                                  : Kind::point;
    lamp.position = Vec3<T>(light.position);
    lamp.direction = Vec3<T>(light.direction);
    lamp.intensity = color_from_rgb<F>(light.intensity);
    lamp.cos_inner = T(light.cos_inner);
    lamp.cos_outer = T(light.cos_outer);
    return lamp;
}

/// Appends an attribute of a mesh to that of a larger one. Where only one of the two has it, the other gets zeros.
///
/// @param before, count  vertices of the larger mesh and of the other
template <class Value>
void append_attribute(std::vector<Value>& all, std::size_t before, const std::vector<Value>& more, std::size_t count) {
    if (all.empty() && more.empty())
        return;
    all.resize(before, Value(0));
    all.insert(all.end(), more.begin(), more.end());
    all.resize(before + count, Value(0));
}

template <class T>
void add_mesh(MeshData<T>& all, const MeshDescription& mesh, std::uint32_t material) {
    const std::size_t before = all.positions.size(), count = mesh.positions.size();
    for (std::size_t set = 0; set < all.coordinates.size(); ++set)
        append_attribute(all.coordinates[set], before, mesh.coordinates[set], count);
    append_attribute(all.tangents, before, mesh.tangents, count);
    for (std::size_t i = 0; i < count; ++i) {
        all.positions.emplace_back(mesh.positions[i]);
        all.normals.push_back(mesh.normals.empty() ? Vec3<T>(0) : Vec3<T>(mesh.normals[i])); // zero is flat
    }
    const auto first = static_cast<std::uint32_t>(before);
    for (const auto& [a, b, c] : mesh.triangles) {
        all.triangles.push_back({first + a, first + b, first + c});
        all.materials.push_back(material);
    }
}

} // namespace detail

/// All meshes become one, with one hierarchy over its triangles.
template <class T, Flux F = Vec3<T>>
[[nodiscard]] GltfScene<T, F> scene_from(const SceneDescription& description) {
    GltfScene<T, F> result;
    result.warnings = description.warnings;
    detail::MeshMaterials<F> materials(description, result.warnings);

    MeshData<T> all;
    for (const MeshDescription& mesh : description.meshes)
        if (description.materials[mesh.material].coverage > 0) // not fully transparent
            detail::add_mesh(all, mesh, materials.of(mesh));
    std::vector<typename Scene<T, F>::Part> parts;
    if (!all.triangles.empty())
        parts.push_back({TriangleMesh<T>(std::move(all)), 0});
    result.scene = Scene<T, F>(std::move(parts), materials.take());
    for (const LightDescription& light : description.lights)
        if (light.kind == LightDescription::Kind::directional && light.angular_diameter > 0)
            result.lamps.environments.push_back(std::make_shared<const Environment<T, F>>(Environment<T, F>::sun(
                Vec3<T>(light.direction), color_from_rgb<F>(light.intensity), T(light.angular_diameter))));
        else
            result.lamps.lamps.push_back(detail::lamp_from<T, F>(light));
    result.lamps.areas = area_lamps(result.scene);
    begin_in_media(result.scene, result.lamps);
    return result;
}

} // namespace nephroid::examples
