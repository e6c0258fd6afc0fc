// SPDX-License-Identifier: MIT
/// @file  A glTF file's materials as those of a scene.
#pragma once

#include "common/gltf.hpp"
#include "common/gltf/enclosure.hpp"
#include "common/material.hpp"
#include "common/text.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace nephroid::examples::detail {

using FileTextures = std::vector<std::shared_ptr<const Texture>>;

/// @return  null for a material without textures
[[nodiscard]] inline std::shared_ptr<const MaterialTextures> textures_from(const MaterialDescription& m,
                                                                           const FileTextures& textures) {
    if (!m.color_texture && !m.transmission_texture && !m.normal_texture)
        return nullptr;
    const auto layer = [&](const std::optional<TextureReference>& reference) {
        return reference ? MaterialTextures::Layer{textures[reference->texture], *reference}
                         : MaterialTextures::Layer{};
    };
    return std::make_shared<const MaterialTextures>(
        MaterialTextures{layer(m.color_texture), layer(m.transmission_texture), layer(m.normal_texture),
                         double(m.normal_scale), m.has_opacity_texture, double(m.alpha_cutoff)});
}

/// Surfaces are either smooth or diffuse here. A rough surface becomes whichever it is closer to, and a note says so.
///
/// @param textures   of the file
/// @param is_window  whether a transmitting material without a volume is a thin pane, as in glTF, or a solid's surface
template <Flux F>
[[nodiscard]] Material<F> material_from(const MaterialDescription& m, const FileTextures& textures, bool is_window,
                                        std::vector<std::string>& warnings) {
    constexpr float rough = MaterialDescription::roughest_mirror;
    const auto warn = [&](const std::string& what) { warnings.push_back("material \"" + m.name + "\": " + what); };
    const auto number = [](float value) { return text("%g", double(value)); };
    const F color = color_from_rgb<F>(m.base_color);

    if (m.emits()) {
        if (m.color_texture || m.transmission_texture || m.normal_texture || m.coverage < 1)
            warn("its opacity and textures are not used, as it emits");
        return Material<F>::emitter(color_from_rgb<F>(m.emission), m.double_sided);
    }
    Material<F> material = Material<F>::diffuse(color);
    if (m.transmission > 0 && m.ior > 0) {
        if (m.roughness > 0)
            warn("is glass of roughness " + number(m.roughness) + ", shown smooth");
        if (m.metallic > 0)
            warn("transmits although it is metallic, taken for glass; set metallicFactor to 0");
        material = is_window ? Material<F>::window(double(m.ior)) : Material<F>::dielectric(double(m.ior));
        material.color = color;
        material.transmission = double(m.transmission);
        material.dispersion = double(m.dispersion);
        if (m.has_volume && std::isfinite(m.attenuation_distance))
            material.absorption =
                absorption_from<F>(color_from_rgb<F>(m.attenuation_color), double(m.attenuation_distance));
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
    material.textures = textures_from(m, textures);
    if (m.normal_texture && material.surface == Surface::diffuse)
        warn("has a normal map, which counts for light straight from lamps and not for caustics on it");
    material.coverage = double(m.coverage);
    const char* const passes =
        " (its opacity): the rest of the light passes unbent; glass that bends it has KHR_materials_transmission";
    if (m.has_opacity_texture && !(m.alpha_cutoff > 0))
        warn(std::string("is there as far as its texture says") + passes);
    else if (m.coverage < 1)
        warn("is there by " + number(m.coverage) + passes);
    return material;
}

/// The materials of the meshes. A transmitting material without a volume becomes two: the surface of a solid for closed
/// meshes, and a thin window for others.
template <Flux F>
class MeshMaterials {
public:
    /// The description and the warnings are kept by reference.
    MeshMaterials(const SceneDescription& scene, std::vector<std::string>& warnings)
        : described_(scene.materials), textures_(scene.textures), warnings_(warnings),
          windows_(described_.size(), none) {
        for (const MaterialDescription& material : described_)
            materials_.push_back(material_from<F>(material, textures_, false, warnings_));
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
            materials_.push_back(material_from<F>(m, textures_, true, said_before));
        }
        return windows_[index];
    }

    [[nodiscard]] std::vector<Material<F>> take() { return std::move(materials_); }

private:
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    const std::vector<MaterialDescription>& described_;
    const FileTextures& textures_;
    std::vector<std::string>& warnings_;
    std::vector<std::uint32_t> windows_; ///< index of the window, by material of the file
    std::vector<Material<F>> materials_;
};

} // namespace nephroid::examples::detail
