// SPDX-License-Identifier: MIT
/// @file  A glTF 2.0 file (.gltf or .glb) as plain data in world space: triangle meshes, materials, lights and cameras.
#pragma once

#include "common/texture.hpp"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace nephroid::examples {

/// One primitive of the mesh of one node. If several nodes have the same mesh, each has its own description.
struct MeshDescription {
    std::string name; ///< of the node, or else of the mesh, or "mesh 3"
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals; ///< unit length, one for each position; empty: the triangles are flat
    std::vector<std::array<std::uint32_t, 3>> triangles; ///< at least one; counter-clockwise seen from the front
    std::size_t material = 0;                            ///< index into `SceneDescription::materials`
    std::array<std::vector<glm::vec2>, 2> coordinates;   ///< of the textures that the material uses: sets 0 and 1
    /// For a normal map, one for each position, or empty: along x, y, z the map's first axis, of unit length, and in w
    /// the sign of its second, cross(normal, tangent) · w. Zero: unknown.
    std::vector<glm::vec4> tangents;
};

/// Colours are linear. The defaults are glTF's: a material without properties is a white, rough metal.
struct MaterialDescription {
    std::string name;
    glm::vec3 base_color{1}; ///< in [0, 1]
    float coverage = 1; ///< in [0, 1]: the opacity of alphaMode BLEND; of MASK 0 or 1. The rest passes straight through
    float metallic = 1; ///< in [0, 1]
    float roughness = 1;    ///< in [0, 1]
    float transmission = 0; ///< in [0, 1]
    float ior = 1.5f;       ///< >= 1, or 0: the specular-glossiness mode of KHR_materials_ior, Fresnel reflectance 1
    float dispersion = 0;   ///< >= 0: 20 over the Abbe number
    bool has_volume =
        false; ///< KHR_materials_volume with a thickness: the mesh bounds a medium, or else is a thin wall
    glm::vec3 attenuation_color{1}; ///< in [0, 1]: the share left after `attenuation_distance`
    float attenuation_distance = std::numeric_limits<float>::infinity(); ///< > 0, world units
    glm::vec3 emission{0}; ///< radiance: emissiveFactor times emissiveStrength
    bool double_sided = false;
    std::optional<TextureReference> color_texture;        ///< its colours, in sRGB, are factors of `base_color`
    std::optional<TextureReference> transmission_texture; ///< its red is a factor of `transmission`
    std::optional<TextureReference> normal_texture;
    float normal_scale = 1;           ///< of the first two components of the normal map
    bool has_opacity_texture = false; ///< the opacity of the colour texture is a factor of `coverage`
    float alpha_cutoff = 0; ///< above 0, with such a texture: less coverage counts as 0, the rest as 1 (alphaMode MASK)

    /// Whether one of its textures needs a set of coordinates.
    [[nodiscard]] bool uses_coordinates(std::size_t set) const {
        const auto uses = [set](const std::optional<TextureReference>& texture) {
            return texture && texture->set == set;
        };
        return uses(color_texture) || uses(transmission_texture) || uses(normal_texture);
    }
    [[nodiscard]] bool emits() const { return emission.x > 0 || emission.y > 0 || emission.z > 0; }
    /// Whether it may make a caustic: smooth metal, and surfaces that transmit light or do not cover all of their area.
    [[nodiscard]] bool is_specular() const {
        const bool is_smooth = roughness < roughest_mirror;
        const bool reflects = is_smooth && (metallic >= 0.5f || !(ior > 0));
        return !emits() && (reflects || (transmission > 0 && ior > 0) || coverage < 1 || has_opacity_texture);
    }
    /// Metals of this roughness or more are rendered as diffuse.
    static constexpr float roughest_mirror = 0.4f;
};

/// KHR_lights_punctual, with its units taken as radiometric.
struct LightDescription {
    enum class Kind { directional, point, spot };

    std::string name;
    Kind kind = Kind::directional;
    glm::vec3 position{0};         ///< without meaning for a directional light
    glm::vec3 direction{0, 0, -1}; ///< in which the light travels, unit length; without meaning for a point light
    glm::vec3 intensity{1};        ///< color times intensity: W/m^2 across the beam if directional, else W/sr
    float cos_inner = 1;           ///< of a spot: full intensity within this angle from `direction`; > cos_outer
    float cos_outer = 0.70710678f; ///< of a spot: nothing beyond this angle
    float range = std::numeric_limits<float>::infinity(); ///< the file's hint at its reach; > 0, world units
    float angular_diameter = 0; ///< of a directional light, radians, for a sun; no file has it
};

struct CameraDescription {
    enum class Kind { perspective, orthographic };

    std::string name;
    Kind kind = Kind::perspective;
    float yfov = 0.8f;           ///< of a perspective camera: the full vertical angle in radians, in (0, pi)
    std::optional<float> aspect; ///< of a perspective camera: width over height, where the file says it
    float xmag = 1; ///< of an orthographic camera: half its width in world units, > 0; a node's scale is ignored
    float ymag = 1; ///< of an orthographic camera: half its height in world units, > 0; a node's scale is ignored
    glm::vec3 position{0};
    glm::vec3 right{1, 0, 0}; ///< unit length, as `up` and `forward`; the three are orthogonal
    glm::vec3 up{0, 1, 0};
    glm::vec3 forward{0, 0, -1}; ///< cross(up, right)
};

struct SceneDescription {
    std::vector<MeshDescription> meshes;        ///< in the order of the node graph; may be empty
    std::vector<MaterialDescription> materials; ///< those of the file; glTF's default at the end where a mesh needs it
    std::vector<std::shared_ptr<const Texture>> textures; ///< that materials use
    std::vector<LightDescription> lights;
    std::vector<CameraDescription> cameras;
    std::vector<std::string> warnings; ///< one line for each thing that was left out or repaired
    glm::dvec3 origin{0}; ///< the file's point that is 0 here: not 0 if the scene is far from the file's origin
};

/// A file that cannot be read, with the warnings before the error.
struct UnreadableGltf : std::runtime_error {
    std::vector<std::string> warnings;

    UnreadableGltf(const std::string& problem, std::vector<std::string> noticed)
        : std::runtime_error(problem), warnings(std::move(noticed)) {}
};

/// Reads the default scene of a file, or its first; without scenes every root node.
///
/// Read: triangles, strips and fans, accessors of every component type, sparse and interleaved ones, buffers inside the
/// file, beside it and as data URIs, nested transforms (a mirroring one keeps the front in front), and the extensions
/// KHR_lights_punctual, KHR_mesh_quantization, KHR_materials_transmission, _ior, _dispersion, _volume and
/// _emissive_strength, and EXT_mesh_gpu_instancing. A scene whose specular surfaces are far from the origin is moved to
/// the origin in double precision, because a caustic needs all seven digits of a float.
/// Textures of base colour, transmission and normals are read from PNG and JPEG, with KHR_texture_transform.
/// Left out with a warning: points and lines, other textures, vertex colours, animation, skins and morph targets.
/// An image takes 24 bytes a pixel while it is decoded; one beside the scene's file counts as part of that.
/// Triangles without area are dropped; normals of length zero are replaced by those of the triangles around.
///
/// Throws UnreadableGltf, one line with the file, what is wrong and where, for anything that is not such a file: also
/// for a required extension that is not read, an index or an accessor out of bounds, a vertex that is not finite,
/// a primitive without triangles, nodes that form a cycle, and a scene that grows out of all proportion to its file by
/// showing meshes again and again. Not checked: that the scene has anything in it to render.
[[nodiscard]] SceneDescription read_gltf(const std::filesystem::path& path);

/// Reads a file from memory.
///
/// @param path  of the file, for messages; buffers are looked for in the same folder
/// Throws what `read_gltf` does.
[[nodiscard]] SceneDescription parse_gltf(std::span<const unsigned char> file, const std::filesystem::path& path);

} // namespace nephroid::examples
