// SPDX-License-Identifier: MIT
/// @file  A glTF file's description as a scene with lamps and a camera.
#pragma once

#include "common/camera.hpp"
#include "common/gltf.hpp"
#include "common/gltf/enclosure.hpp"
#include "common/lamps.hpp"
#include "common/text.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
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

template <Flux F>
[[nodiscard]] F color_from(const glm::vec3& rgb) {
    if constexpr (std::floating_point<F>)
        return static_cast<F>((rgb.x + rgb.y + rgb.z) / 3);
    else
        return F(rgb);
}

/// Surfaces are either smooth or diffuse here. A rough surface becomes whichever it is closer to, and a note says so.
///
/// @param is_window  whether a transmitting material without a volume is a thin pane, as in glTF, or a solid's surface
template <Flux F>
[[nodiscard]] Material<F> material_from(const MaterialDescription& m, bool is_window,
                                        std::vector<std::string>& warnings) {
    constexpr float rough = MaterialDescription::roughest_mirror;
    const auto warn = [&](const std::string& what) { warnings.push_back("material \"" + m.name + "\": " + what); };
    const auto number = [](float value) { return text("%g", double(value)); };
    const F color = color_from<F>(m.base_color);

    if (m.emits())
        return Material<F>::emitter(color_from<F>(m.emission), m.double_sided);
    Material<F> material = Material<F>::diffuse(color);
    if (m.transmission > 0 && m.ior > 0) {
        if (m.roughness > 0)
            warn("is glass of roughness " + number(m.roughness) + ", shown smooth");
        if (m.metallic > 0)
            warn("transmits although it is metallic, taken for glass; set metallicFactor to 0");
        material = is_window ? Material<F>::window(double(m.ior)) : Material<F>::dielectric(double(m.ior));
        material.color = color;
        material.transmission = double(m.transmission);
        if (m.has_volume && std::isfinite(m.attenuation_distance))
            material.absorption =
                absorption_from<F>(color_from<F>(m.attenuation_color), double(m.attenuation_distance));
    } else if (m.roughness < rough && !(m.ior > 0)) {
        warn("has an index of refraction of 0, with which glTF lets nothing pass: shown as a mirror");
        material = Material<F>::mirror(grey<F>(1));
    } else if (m.metallic >= 0.5f && m.roughness < rough) {
        if (m.roughness > 0)
            warn("is metal of roughness " + number(m.roughness) + ", shown smooth");
        if (m.metallic < 1)
            warn("is metallic by " + number(m.metallic) + " only, shown as a whole mirror");
        material = Material<F>::mirror(color);
    } else if (m.metallic >= 0.5f) {
        warn("is rough metal, shown diffuse");
    } else if (m.transmission > 0) {
        warn("has no index of refraction and is rough, shown diffuse and opaque");
    } else if (m.roughness < rough) {
        warn("is glossy, of roughness " + number(m.roughness) + ", shown diffuse");
    }
    material.coverage = double(m.coverage);
    if (m.coverage < 1)
        warn("is there by " + number(m.coverage) +
             " (its opacity): the rest of the light passes unbent; glass that bends it has KHR_materials_transmission");
    return material;
}

/// The materials of the meshes. A transmitting material without a volume becomes two: the surface of a solid for closed
/// meshes, and a thin window for others.
template <Flux F>
class MeshMaterials {
public:
    MeshMaterials(const std::vector<MaterialDescription>& described, std::vector<std::string>& warnings)
        : described_(described), warnings_(warnings), windows_(described.size(), none) {
        for (const MaterialDescription& material : described)
            materials_.push_back(material_from<F>(material, false, warnings_));
    }

    /// @return  index into the materials
    [[nodiscard]] std::uint32_t of(const MeshDescription& mesh) {
        const std::size_t index = mesh.material;
        const MaterialDescription& m = described_[index];
        if (materials_[index].surface != Surface::dielectric)
            return static_cast<std::uint32_t>(index);
        const gltf::Enclosure enclosure = gltf::enclosure_of(mesh);
        if (enclosure.is_closed && enclosure.volume < 0)
            warnings_.push_back(
                "mesh \"" + mesh.name + "\" of material \"" + m.name +
                "\" seems to be inside out: its triangles face inwards, so that the glass is around it; "
                "turn them, unless it is a bubble");
        if (!m.has_volume && enclosure.is_closed)
            warnings_.push_back("mesh \"" + mesh.name + "\" of material \"" + m.name +
                                "\" transmits and has no volume: as it is closed it is taken for solid glass; give the "
                                "material a thickness (KHR_materials_volume)");
        if (m.has_volume || enclosure.is_closed)
            return static_cast<std::uint32_t>(index);
        if (windows_[index] == none) {
            warnings_.push_back("material \"" + m.name +
                                "\" transmits and has no volume: a thin window, through "
                                "which light goes straight; the surface of a solid has a thickness "
                                "(KHR_materials_volume)");
            windows_[index] = static_cast<std::uint32_t>(materials_.size());
            std::vector<std::string> said_before;
            materials_.push_back(material_from<F>(m, true, said_before));
        }
        return windows_[index];
    }

    [[nodiscard]] std::vector<Material<F>> take() { return std::move(materials_); }

private:
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    const std::vector<MaterialDescription>& described_;
    std::vector<std::string>& warnings_;
    std::vector<std::uint32_t> windows_; ///< index of the window, by material of the file
    std::vector<Material<F>> materials_;
};

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
    detail::MeshMaterials<F> materials(description.materials, result.warnings);

    MeshData<T> all;
    for (const MeshDescription& mesh : description.meshes) {
        const auto first = static_cast<std::uint32_t>(all.positions.size());
        if (description.materials[mesh.material].coverage == 0)
            continue; // fully transparent
        const std::uint32_t material = materials.of(mesh);
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            all.positions.emplace_back(mesh.positions[i]);
            all.normals.push_back(mesh.normals.empty() ? Vec3<T>(0) : Vec3<T>(mesh.normals[i])); // zero is flat
        }
        for (const auto& [a, b, c] : mesh.triangles) {
            all.triangles.push_back({first + a, first + b, first + c});
            all.materials.push_back(material);
        }
    }
    std::vector<typename Scene<T, F>::Part> parts;
    if (!all.triangles.empty())
        parts.push_back({TriangleMesh<T>(std::move(all)), 0});
    result.scene = Scene<T, F>(std::move(parts), materials.take());
    for (const LightDescription& light : description.lights)
        if (light.kind == LightDescription::Kind::directional && light.angular_diameter > 0)
            result.lamps.environments.push_back(std::make_shared<const Environment<T, F>>(Environment<T, F>::sun(
                Vec3<T>(light.direction), detail::color_from<F>(light.intensity), T(light.angular_diameter))));
        else
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

/// The width over the height of a file's camera; 1 if it has none.
[[nodiscard]] inline double aspect_of(const CameraDescription& c) {
    if (c.kind == CameraDescription::Kind::orthographic)
        return double(c.xmag) / double(c.ymag);
    return double(c.aspect.value_or(1.0f));
}

/// A camera for files without one: it shows a whole box from the front and above, with y upwards as in glTF.
///
/// @param aspect  of the film, width over height
template <class T>
[[nodiscard]] CameraDescription camera_for(const Box<T>& bounds, double aspect = 1) {
    CameraDescription c;
    c.name = "default";
    const glm::vec3 low(bounds.min), high(bounds.max), middle = 0.5f * (low + high);
    const float radius = 0.5f * length(high - low), tilt = 0.5f;
    const float half_angle = std::atan(std::tan(0.5f * c.yfov) * static_cast<float>((std::min)(1.0, aspect)));
    c.forward = {0, -std::sin(tilt), -std::cos(tilt)};
    c.up = {0, std::cos(tilt), -std::sin(tilt)};
    c.position = middle - radius / std::sin(half_angle) * c.forward;
    return c;
}

/// Moves a camera in front of objects between it and its subject, and widens its view to show the same.
///
/// @param middle  of the subject; specular surfaces block the view
template <class T, Flux F>
void step_inside(CameraDescription& camera, const Scene<T, F>& scene, const glm::vec3& middle) {
    const Vec3<T> back(-camera.forward);
    const T wanted = length(Vec3<T>(camera.position - middle));
    T free = T(0);
    for (int surfaces = 0; surfaces < 64 && free < wanted; ++surfaces) {
        const auto hit = scene.intersect(Vec3<T>(middle) + free * back, back, T(0), wanted - free);
        if (!hit)
            return;
        free += hit->distance * T(1.0001);
        if (scene.material(*hit).is_specular())
            continue;
        const T distance = T(0.95) * free;
        constexpr float widest = 2; // radians
        const float half = std::atan(std::tan(0.5f * camera.yfov) * static_cast<float>(wanted / distance));
        camera.position = middle + static_cast<float>(distance) * glm::vec3(back);
        camera.yfov = (std::min)(widest, 2 * half);
        return;
    }
}

} // namespace nephroid::examples
