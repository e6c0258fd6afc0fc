// SPDX-License-Identifier: MIT
#include "common/gltf/material.hpp"

#include "common/gltf/transform.hpp"

#include <glm/vec3.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nephroid::examples::gltf {
namespace {

/// The properties of one extension of a material; those that are missing have their defaults.
class Extension {
public:
    Extension(const tinygltf::Material& material, const char* name, std::string_view owner) : owner_(owner) {
        const auto found = material.extensions.find(name);
        if (found != material.extensions.end() && found->second.IsObject())
            value_ = &found->second;
    }

    [[nodiscard]] bool has(const char* property) const { return value_ != nullptr && value_->Has(property); }

    [[nodiscard]] float number(const char* property, float missing) const {
        if (!has(property))
            return missing;
        const tinygltf::Value& value = value_->Get(property);
        if (!value.IsNumber())
            fail({owner_, " has a ", property, " that is not a number"});
        return to_float(value.GetNumberAsDouble(), owner_, property);
    }

    [[nodiscard]] glm::vec3 color(const char* property, const glm::vec3& missing) const {
        if (!has(property))
            return missing;
        const tinygltf::Value& value = value_->Get(property);
        // The array itself: `Value::Get(index)` takes an int or a size_t, by tinygltf's version.
        tinygltf::Value::Array numbers;
        if (value.IsArray())
            numbers = value.Get<tinygltf::Value::Array>();
        glm::vec3 result(0);
        for (std::size_t i = 0; i < 3; ++i) {
            if (numbers.size() != 3 || !numbers[i].IsNumber())
                fail({owner_, " has a ", property, " that is not three numbers"});
            result[static_cast<int>(i)] = to_float(numbers[i].GetNumberAsDouble(), owner_, property);
        }
        return result;
    }

private:
    const tinygltf::Value* value_ = nullptr;
    std::string_view owner_;
};

/// Moves factors into [0, 1].
class Clamp {
public:
    Clamp(std::string_view owner, Warnings& warnings) : owner_(owner), warnings_(warnings) {}

    float operator()(float value, const char* property) const {
        if (!(value >= 0 && value <= 1))
            warnings_.add(std::string(owner_) + " has a " + property + " outside of 0 to 1; it is clamped");
        return (std::clamp)(value, 0.f, 1.f);
    }
    glm::vec3 operator()(const glm::vec3& value, const char* property) const {
        return {(*this)(value.x, property), (*this)(value.y, property), (*this)(value.z, property)};
    }

private:
    std::string_view owner_;
    Warnings& warnings_;
};

glm::vec3 color_from(const std::vector<double>& factors, std::string_view owner, std::string_view property) {
    if (factors.size() < 3)
        fail({owner, " has a ", property, " of ", std::to_string(factors.size()), " numbers"});
    return {to_float(factors[0], owner, property), to_float(factors[1], owner, property),
            to_float(factors[2], owner, property)};
}

/// A reference to a texture in an extension, which tinygltf leaves as JSON.
std::optional<TextureReference> texture_in(const tinygltf::Material& material, const char* extension,
                                           const char* property, TextureReader& textures, const std::string& owner) {
    const auto found = material.extensions.find(extension);
    if (found == material.extensions.end() || !found->second.Has(property))
        return std::nullopt;
    const tinygltf::Value& reference = found->second.Get(property);
    const auto whole_number = [&](const char* name, int missing) {
        return reference.Has(name) && reference.Get(name).IsInt() ? reference.Get(name).GetNumberAsInt() : missing;
    };
    tinygltf::ExtensionMap extensions;
    if (reference.Has("extensions") && reference.Get("extensions").IsObject())
        for (const auto& [name, value] : reference.Get("extensions").Get<tinygltf::Value::Object>())
            extensions.emplace(name, value);
    return textures.reference(whole_number("index", -1), whole_number("texCoord", 0), extensions, owner);
}

void read_textures(MaterialDescription& result, const tinygltf::Material& material, TextureReader& textures,
                   const std::string& owner) {
    const auto& color = material.pbrMetallicRoughness.baseColorTexture;
    result.color_texture = textures.reference(color.index, color.texCoord, color.extensions, owner);
    result.transmission_texture =
        texture_in(material, "KHR_materials_transmission", "transmissionTexture", textures, owner);
    const auto& normal = material.normalTexture;
    result.normal_texture = textures.reference(normal.index, normal.texCoord, normal.extensions, owner);
    result.normal_scale = to_float(normal.scale, owner, "normalTexture.scale");
}

/// Reads how much of its area a surface covers, by its opacity. Source: glTF 2.0, section 3.9.4, alpha coverage.
void read_coverage(MaterialDescription& result, const tinygltf::Material& material, std::string_view owner,
                   const Clamp& clamp) {
    const bool is_mask = material.alphaMode == "MASK";
    if (!is_mask && material.alphaMode != "BLEND")
        return;
    const std::vector<double>& factor = material.pbrMetallicRoughness.baseColorFactor;
    const float alpha = factor.size() < 4 ? 1.f : clamp(to_float(factor[3], owner, "opacity"), "opacity");
    const float cutoff = to_float(material.alphaCutoff, owner, "alphaCutoff");
    result.coverage = alpha;
    if (is_mask && !(cutoff > 0)) { // no opacity is below it
        result.coverage = 1;
    } else if (result.color_texture) {
        result.has_opacity_texture = true;
        result.alpha_cutoff = is_mask ? cutoff : 0;
    } else if (is_mask) {
        result.coverage = double{alpha} >= material.alphaCutoff ? 1.f : 0.f;
    }
}

/// The textures that are not read, for a warning; empty if there are none.
std::string unread_textures(const tinygltf::Material& material) {
    std::string names;
    const auto list = [&names](const std::string& name) { names += (names.empty() ? "" : ", ") + name; };
    if (material.pbrMetallicRoughness.metallicRoughnessTexture.index >= 0)
        list("metallicRoughnessTexture");
    if (material.emissiveTexture.index >= 0)
        list("emissiveTexture");
    for (const auto& [name, extension] : material.extensions)
        if (extension.IsObject())
            for (const std::string& property : extension.Keys())
                if (property.ends_with("Texture") && property != "transmissionTexture")
                    list(property);
    return names;
}
} // namespace

MaterialDescription read_material(const tinygltf::Material& material, std::size_t index, TextureReader& textures,
                                  Warnings& warnings) {
    const std::string owner = named("material", index, material.name);
    const Clamp clamp(owner, warnings);
    const auto& surface = material.pbrMetallicRoughness;

    MaterialDescription result;
    result.name = material.name.empty() ? named("material", index, "") : material.name;
    result.double_sided = material.doubleSided;
    result.base_color = clamp(color_from(surface.baseColorFactor, owner, "baseColorFactor"), "baseColorFactor");
    result.metallic = clamp(to_float(surface.metallicFactor, owner, "metallicFactor"), "metallicFactor");
    result.roughness = clamp(to_float(surface.roughnessFactor, owner, "roughnessFactor"), "roughnessFactor");
    if (const std::string unread = unread_textures(material); !unread.empty())
        warnings.add(owner + " has textures that are not read, only their factors: " + unread);
    read_textures(result, material, textures, owner);
    read_coverage(result, material, owner, clamp);

    const Extension transmission(material, "KHR_materials_transmission", owner);
    result.transmission = clamp(transmission.number("transmissionFactor", 0), "transmissionFactor");

    result.ior = Extension(material, "KHR_materials_ior", owner).number("ior", 1.5f);
    if (result.ior != 0 && !(result.ior >= 1))
        fail({owner, " has an ior of ", std::to_string(result.ior), "; it must be at least 1, or 0"});

    result.dispersion = Extension(material, "KHR_materials_dispersion", owner).number("dispersion", 0);
    if (!(result.dispersion >= 0)) {
        warnings.add(owner + " has a negative dispersion; it is taken as 0");
        result.dispersion = 0;
    }

    const Extension volume(material, "KHR_materials_volume", owner);
    result.has_volume = volume.number("thicknessFactor", 0) > 0;
    result.attenuation_color = clamp(volume.color("attenuationColor", glm::vec3(1)), "attenuationColor");
    const float distance = volume.number("attenuationDistance", result.attenuation_distance);
    if (distance > 0)
        result.attenuation_distance = distance;
    else
        warnings.add(owner + " has an attenuationDistance that is not above 0; it is taken as infinite");

    const Extension emission(material, "KHR_materials_emissive_strength", owner);
    result.emission = color_from(material.emissiveFactor, owner, "emissiveFactor");
    const float strength = emission.number("emissiveStrength", 1);
    for (int i = 0; i < 3; ++i) {
        const double radiance = double{result.emission[i]} * double{strength};
        if (radiance < 0)
            fail({owner, " has a negative emission"});
        result.emission[i] = to_float(radiance, owner, "emission");
    }
    return result;
}

} // namespace nephroid::examples::gltf
