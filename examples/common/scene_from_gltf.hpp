// SPDX-License-Identifier: MIT
/// @file  A glTF file's description as a scene with lamps and a camera.
#pragma once

#include "common/camera.hpp"
#include "common/gltf.hpp"
#include "common/lamps.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace nephroid::examples {

template <class T, Flux F = Vec3<T>>
struct GltfScene {
    Scene<T, F> scene;
    Lamps<T, F> lamps;
    std::vector<std::string> warnings; ///< what is shown otherwise than the file says, a line each
};

namespace detail {

template <Flux F>
[[nodiscard]] F color_from(const glm::vec3& rgb) {
    if constexpr (std::floating_point<F>)
        return static_cast<F>((rgb.x + rgb.y + rgb.z) / 3);
    else
        return F(rgb);
}

/// Surfaces here are smooth or diffuse: what is more of the one is taken for it whole.
template <Flux F>
[[nodiscard]] Material<F> material_from(const MaterialDescription& m, std::vector<std::string>& warnings) {
    constexpr float rough = 0.4f;
    const auto warn = [&](const char* what) { warnings.push_back("material \"" + m.name + "\": " + what); };
    const F color = color_from<F>(m.base_color);

    if (m.emission.x > 0 || m.emission.y > 0 || m.emission.z > 0)
        return Material<F>::emitter(color_from<F>(m.emission), m.double_sided);
    if (m.transmission > 0 && (m.transmission < 0.5f || !(m.ior > 0)))
        warn(m.ior > 0 ? "transmits less than half, shown as if it did not"
                       : "has no index of refraction, shown opaque");
    if (m.transmission >= 0.5f && m.ior > 0) {
        if (m.roughness >= rough)
            warn("is rough glass, shown smooth");
        if (!m.has_volume)
            warn("transmits, and has no volume: taken for the surface of solid glass");
        Material<F> glass = Material<F>::dielectric(double(m.ior));
        glass.color = color;
        if (m.has_volume && std::isfinite(m.attenuation_distance))
            glass.absorption = absorption_from<F>(color_from<F>(m.attenuation_color), double(m.attenuation_distance));
        return glass;
    }
    if (m.metallic >= 0.5f && m.roughness < rough)
        return Material<F>::mirror(color);
    if (m.metallic >= 0.5f)
        warn("is rough metal, shown diffuse");
    return Material<F>::diffuse(color);
}

template <class T, Flux F>
[[nodiscard]] Lamp<T, F> lamp_from(const LightDescription& light) {
    Lamp<T, F> lamp;
    using Kind = typename Lamp<T, F>::Kind;
    lamp.kind = light.kind == LightDescription::Kind::directional ? Kind::directional
                : light.kind == LightDescription::Kind::spot      ? Kind::spot
                                                                  : Kind::point;
    lamp.position = Vec3<T>(light.position);
    lamp.direction = Vec3<T>(light.direction);
    lamp.intensity = color_from<F>(light.intensity);
    lamp.cos_inner = T(light.cos_inner);
    lamp.cos_outer = T(light.cos_outer);
    return lamp;
}

} // namespace detail

/// All meshes become one, with one hierarchy over its triangles.
template <class T, Flux F = Vec3<T>>
[[nodiscard]] GltfScene<T, F> scene_from(const SceneDescription& description) {
    GltfScene<T, F> result;
    result.warnings = description.warnings;
    std::vector<Material<F>> materials;
    for (const MaterialDescription& material : description.materials)
        materials.push_back(detail::material_from<F>(material, result.warnings));

    MeshData<T> all;
    for (const MeshDescription& mesh : description.meshes) {
        const auto first = static_cast<std::uint32_t>(all.positions.size());
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            all.positions.emplace_back(mesh.positions[i]);
            all.normals.push_back(mesh.normals.empty() ? Vec3<T>(0) : Vec3<T>(mesh.normals[i])); // zero is flat
        }
        for (const auto& [a, b, c] : mesh.triangles) {
            all.triangles.push_back({first + a, first + b, first + c});
            all.materials.push_back(static_cast<std::uint32_t>(mesh.material));
        }
    }
    std::vector<typename Scene<T, F>::Part> parts;
    if (!all.triangles.empty())
        parts.push_back({TriangleMesh<T>(std::move(all)), 0});
    result.scene = Scene<T, F>(std::move(parts), std::move(materials));
    for (const LightDescription& light : description.lights)
        result.lamps.lamps.push_back(detail::lamp_from<T, F>(light));
    result.lamps.areas = area_lamps(result.scene);
    begin_in_media(result.scene, result.lamps);
    return result;
}

/// The camera that a file describes, with a film of the given size: the vertical extent is the file's, the horizontal
/// one follows from the film.
template <class T>
[[nodiscard]] Camera<T> camera_from(const CameraDescription& c, std::size_t width, std::size_t height) {
    const typename Camera<T>::Pose pose{Vec3<T>(c.position), Vec3<T>(c.right), Vec3<T>(c.up), Vec3<T>(c.forward)};
    return c.kind == CameraDescription::Kind::perspective ? Camera<T>::perspective(pose, T(c.yfov), width, height)
                                                          : Camera<T>::orthographic(pose, T(c.ymag), width, height);
}

/// Width over height as a file's camera wants it; 1 where it does not say.
[[nodiscard]] inline double aspect_of(const CameraDescription& c) {
    if (c.kind == CameraDescription::Kind::orthographic)
        return double(c.xmag) / double(c.ymag);
    return double(c.aspect.value_or(1.0f));
}

/// For files without a camera: one that has the whole scene in view, from the front and above, y upwards as in glTF.
template <class T>
[[nodiscard]] CameraDescription camera_for(const Box<T>& bounds) {
    CameraDescription c;
    c.name = "default";
    const glm::vec3 low(bounds.min), high(bounds.max), middle = 0.5f * (low + high);
    const float radius = 0.5f * length(high - low), tilt = 0.5f;
    c.forward = {0, -std::sin(tilt), -std::cos(tilt)};
    c.up = {0, std::cos(tilt), -std::sin(tilt)};
    c.position = middle - radius / std::sin(0.5f * c.yfov) * c.forward;
    return c;
}

} // namespace nephroid::examples
