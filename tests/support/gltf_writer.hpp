// SPDX-License-Identifier: MIT
/// @file  Writes small glTF files for tests: the parts by hand, and whole scenes with a caustic, or with a fault.
#pragma once

#include <glm/vec3.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <limits>
#include <locale>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace nephroid::tests {

inline void append_u32(std::string& bytes, std::size_t value) {
    for (unsigned shift = 0; shift < 32; shift += 8)
        bytes += static_cast<char>(static_cast<unsigned char>(value >> shift));
}

/// A .glb of a JSON chunk and, unless it is empty, a binary chunk.
[[nodiscard]] inline std::string glb_bytes(std::string json, std::string binary = "") {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
    std::string bytes = "glTF";
    append_u32(bytes, 2);
    append_u32(bytes, 12 + 8 + json.size() + (binary.empty() ? 0 : 8 + binary.size()));
    append_u32(bytes, json.size());
    bytes += "JSON" + json;
    if (!binary.empty()) {
        append_u32(bytes, binary.size());
        bytes += std::string("BIN\0", 4) + binary;
    }
    return bytes;
}

inline void write_bytes(const std::filesystem::path& path, std::string_view bytes) {
    std::ofstream file(path, std::ios::binary);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!file)
        throw std::runtime_error("cannot write " + path.string());
}

[[nodiscard]] inline std::string base64(std::string_view bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        unsigned group = 0;
        for (std::size_t k = i; k < i + 3; ++k)
            group = group << 8 | (k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k > bytes.size() ? '=' : digits[group >> (18 - 6 * k) & 63];
    }
    return text;
}

/// A number as JSON.
[[nodiscard]] inline std::string json_number(double value) {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text.precision(std::numeric_limits<double>::max_digits10);
    text << value;
    return text.str();
}

[[nodiscard]] inline std::string json_array(std::initializer_list<double> values) {
    std::string text = "[";
    for (const double value : values) {
        text += text.size() > 1 ? "," : ""; // not joined to the number first: g++ 12 warns of that, falsely
        text += json_number(value);
    }
    return text + "]";
}

/// Collects the parts of a file, each as JSON, and the bytes of its one buffer. `add_` functions return the new index.
struct GltfFile {
    std::string binary;
    std::vector<std::string> views, accessors, meshes, materials, nodes, cameras, lights;
    std::string scenes;             ///< empty: one scene with `roots`
    std::vector<std::size_t> roots; ///< empty: all nodes
    std::string more;               ///< further properties of the file, each with a comma in front

    /// @param properties  of the view, each with a comma in front, such as `,"byteStride":24`
    std::size_t add_view(std::string_view bytes, const std::string& properties = "") {
        binary.resize((binary.size() + 3) / 4 * 4, '\0');
        views.push_back(R"({"buffer":0,"byteOffset":)" + std::to_string(binary.size()) + R"(,"byteLength":)" +
                        std::to_string(bytes.size()) + properties + "}");
        binary += bytes;
        return views.size() - 1;
    }

    /// @param properties  as above, such as `,"normalized":true`
    std::size_t add_accessor(std::size_t view, int component_type, std::size_t count, const std::string& type,
                             const std::string& properties = "") {
        accessors.push_back(R"({"bufferView":)" + std::to_string(view) + R"(,"componentType":)" +
                            std::to_string(component_type) + R"(,"count":)" + std::to_string(count) + R"(,"type":")" +
                            type + "\"" + properties + "}");
        return accessors.size() - 1;
    }

    /// Numbers of any type one after the other, as little-endian machines have them.
    template <class Number>
    [[nodiscard]] static std::string bytes_of(const std::vector<Number>& numbers) {
        std::string bytes(numbers.size() * sizeof(Number), '\0');
        if (!numbers.empty())
            std::memcpy(bytes.data(), numbers.data(), bytes.size());
        return bytes;
    }

    std::size_t add_vectors(const std::vector<glm::vec3>& vectors) {
        static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
        return add_accessor(add_view(bytes_of(vectors)), 5126, vectors.size(), "VEC3");
    }

    /// @tparam Index  of 8, 16 or 32 bits, unsigned
    template <class Index>
    std::size_t add_indices(const std::vector<Index>& indices) {
        constexpr int type = sizeof(Index) == 1 ? 5121 : sizeof(Index) == 2 ? 5123 : 5125;
        return add_accessor(add_view(bytes_of(indices)), type, indices.size(), "SCALAR");
    }

    /// @param primitives  joined by commas
    std::size_t add_mesh(const std::string& primitives, const std::string& name = "") {
        meshes.push_back(R"({"name":")" + name + R"(","primitives":[)" + primitives + "]}");
        return meshes.size() - 1;
    }

    std::size_t add_node(const std::string& json) {
        nodes.push_back(json);
        return nodes.size() - 1;
    }

    /// @param uri  where the buffer is; empty: in the file's binary chunk
    [[nodiscard]] std::string json(const std::string& uri = "") const {
        std::string text = R"({"asset":{"version":"2.0"})";
        const auto section = [&text](const char* name, const std::vector<std::string>& parts) {
            if (!parts.empty())
                text += std::string(",\"") + name + "\":[" + joined(parts) + "]";
        };
        if (!binary.empty())
            text += R"(,"buffers":[{"byteLength":)" + std::to_string(binary.size()) +
                    (uri.empty() ? "" : R"(,"uri":")" + uri + "\"") + "}]";
        section("bufferViews", views);
        section("accessors", accessors);
        section("meshes", meshes);
        section("materials", materials);
        section("nodes", nodes);
        section("cameras", cameras);
        if (!lights.empty())
            text += R"(,"extensionsUsed":["KHR_lights_punctual"],"extensions":{"KHR_lights_punctual":{"lights":[)" +
                    joined(lights) + "]}}";
        if (!scenes.empty())
            return text + R"(,"scenes":)" + scenes + more + "}";

        std::vector<std::string> listed;
        for (std::size_t i = 0; i < (roots.empty() ? nodes.size() : roots.size()); ++i)
            listed.push_back(std::to_string(roots.empty() ? i : roots[i]));
        return text + R"(,"scene":0,"scenes":[{"nodes":[)" + joined(listed) + "]}]" + more + "}";
    }

    [[nodiscard]] std::string glb() const { return glb_bytes(json(), binary); }

    [[nodiscard]] static std::string joined(const std::vector<std::string>& parts) {
        std::string text;
        for (const std::string& part : parts) {
            text += text.empty() ? "" : ",";
            text += part;
        }
        return text;
    }
};

/// Vertices and triangles; the normals may be missing.
struct TestMesh {
    std::vector<glm::vec3> positions, normals;
    std::vector<std::uint32_t> indices;
};

/// A sphere of meridians and parallels about the y axis, with exact normals, its front outside.
[[nodiscard]] inline TestMesh uv_sphere(float radius, std::uint32_t meridians = 32, std::uint32_t parallels = 16) {
    TestMesh mesh;
    const auto angle = [](std::uint32_t i, std::uint32_t n) { return std::numbers::pi * double(i) / double(n); };
    for (std::uint32_t i = 0; i <= parallels; ++i) {
        for (std::uint32_t k = 0; k <= meridians; ++k) {
            const double theta = angle(i, parallels), phi = 2 * angle(k % meridians, meridians);
            const double s = i == 0 || i == parallels ? 0 : std::sin(theta);
            const glm::vec3 n(float(s * std::sin(phi)), float(std::cos(theta)), float(s * std::cos(phi)));
            mesh.positions.push_back(radius * n);
            mesh.normals.push_back(n);
        }
    }
    for (std::uint32_t i = 0; i < parallels; ++i) {
        for (std::uint32_t k = 0; k < meridians; ++k) {
            const std::uint32_t a = i * (meridians + 1) + k, b = a + meridians + 1;
            if (i > 0)
                mesh.indices.insert(mesh.indices.end(), {a, b, a + 1});
            if (i + 1 < parallels)
                mesh.indices.insert(mesh.indices.end(), {a + 1, b, b + 1});
        }
    }
    return mesh;
}

/// A square about the origin in the plane y = 0, its front and its normals upwards.
[[nodiscard]] inline TestMesh horizontal_square(float half_size) {
    const float h = half_size;
    const glm::vec3 up(0, 1, 0);
    return {{{-h, 0, -h}, {-h, 0, h}, {h, 0, h}, {h, 0, -h}}, {up, up, up, up}, {0, 1, 2, 0, 2, 3}};
}

/// @param material  index, or -1 for none
inline std::size_t add_mesh(GltfFile& file, const TestMesh& mesh, const std::string& name, int material = -1) {
    std::string primitive = R"({"attributes":{"POSITION":)" + std::to_string(file.add_vectors(mesh.positions));
    if (!mesh.normals.empty())
        primitive += R"(,"NORMAL":)" + std::to_string(file.add_vectors(mesh.normals));
    primitive += R"(},"indices":)" + std::to_string(file.add_indices(mesh.indices));
    if (material >= 0)
        primitive += R"(,"material":)" + std::to_string(material);
    return file.add_mesh(primitive + "}", name);
}

enum class TestLight { none, sun, quad };
enum class TestSphere { glass, mirror, diffuse };

/// A sphere of radius 0.5 at (0, 1, 0) over a white diffuse floor, y = 0, of half-size 3; a perspective camera from the
/// front, above. The sun, of irradiance 3, shines straight down; the quad, of half-size 0.25 at y = 3 and radiance 40,
/// faces down.
[[nodiscard]] inline GltfFile caustic_scene(TestLight light = TestLight::sun, TestSphere sphere = TestSphere::glass) {
    GltfFile file;
    const auto surface = [](const std::string& name, const std::string& factors, const std::string& more = "") {
        return R"({"name":")" + name + R"(","pbrMetallicRoughness":{)" + factors + "}" + more + "}";
    };
    file.materials.push_back(
        surface("floor", R"("baseColorFactor":[0.8,0.8,0.8,1],"metallicFactor":0,"roughnessFactor":1)"));
    if (sphere == TestSphere::glass)
        file.materials.push_back(surface("glass", R"("metallicFactor":0,"roughnessFactor":0)",
                                         R"(,"extensions":{"KHR_materials_transmission":{"transmissionFactor":1},)"
                                         R"("KHR_materials_ior":{"ior":1.5},)"
                                         R"("KHR_materials_volume":{"thicknessFactor":1}})"));
    else if (sphere == TestSphere::mirror)
        file.materials.push_back(surface("mirror", R"("metallicFactor":1,"roughnessFactor":0)"));
    else
        file.materials.push_back(surface("chalk", R"("metallicFactor":0,"roughnessFactor":1)"));

    const auto show = [&file](std::size_t mesh, const std::string& placed) {
        file.add_node(R"({"mesh":)" + std::to_string(mesh) + placed + "}");
    };
    show(add_mesh(file, horizontal_square(3), "floor", 0), "");
    show(add_mesh(file, uv_sphere(0.5f), "sphere", 1), R"(,"translation":[0,1,0])");

    const double half = std::sqrt(0.5);
    if (light == TestLight::sun) {
        file.lights.emplace_back(R"({"type":"directional","name":"sun","intensity":3})");
        file.add_node(R"({"name":"sun","rotation":)" + json_array({-half, 0, 0, half}) +
                      R"(,"extensions":{"KHR_lights_punctual":{"light":0}}})");
    } else if (light == TestLight::quad) {
        file.materials.push_back(surface("lamp", R"("baseColorFactor":[0,0,0,1],"metallicFactor":0)",
                                         R"(,"emissiveFactor":[1,1,1],"extensions":{"KHR_materials_emissive_strength":)"
                                         R"({"emissiveStrength":40}})"));
        show(add_mesh(file, horizontal_square(0.25f), "lamp", 2), R"(,"translation":[0,3,0],"rotation":[1,0,0,0])");
    }

    file.cameras.emplace_back(R"({"type":"perspective","perspective":{"yfov":0.7,"aspectRatio":1,"znear":0.01}})");
    const double tilt = std::atan2(2.0, 5.0) / 2; // downwards, from (0, 2.5, 5) to (0, 0.5, 0)
    file.add_node(R"({"name":"camera","camera":0,"translation":[0,2.5,5],"rotation":)" +
                  json_array({-std::sin(tilt), 0, 0, std::cos(tilt)}) + "}");
    return file;
}

/// A .glb with a sphere whose vertex 40 has a y that is not a number.
[[nodiscard]] inline std::string glb_with_nan() {
    GltfFile file;
    TestMesh sphere = uv_sphere(0.5f);
    sphere.positions[40].y = std::numeric_limits<float>::quiet_NaN();
    file.add_node(R"({"mesh":)" + std::to_string(add_mesh(file, sphere, "sphere")) + "}");
    return file.glb();
}

/// The .glb of `caustic_scene` without its second half.
[[nodiscard]] inline std::string truncated_glb() {
    const std::string whole = caustic_scene().glb();
    return whole.substr(0, whole.size() / 2);
}

/// A .glb with a square whose last index is 4, of 4 vertices.
[[nodiscard]] inline std::string glb_with_bad_index() {
    GltfFile file;
    TestMesh square = horizontal_square(1);
    square.indices.back() = 4;
    file.add_node(R"({"mesh":)" + std::to_string(add_mesh(file, square, "square")) + "}");
    return file.glb();
}

} // namespace nephroid::tests
