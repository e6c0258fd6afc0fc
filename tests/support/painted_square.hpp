// SPDX-License-Identifier: MIT
/// @file  A glTF file of a square with an image on it.
#pragma once

#include "common/scene_from_gltf.hpp"
#include "support/gltf_reading.hpp"
#include "support/png_writer.hpp"

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace nephroid::tests {

/// A square of half-size 1 in the plane y = 0. Seen from above, with +x to the right and +z downwards, it shows the
/// image as it is.
struct PaintedSquare {
    GltfFile file;

    /// @param material  as JSON; its textures have the index 0
    /// @param png       the image
    /// @param sampler   as JSON
    explicit PaintedSquare(const std::string& material, const std::string& png, const std::string& sampler = "{}") {
        const TestMesh square = horizontal_square(1);
        std::vector<glm::vec2> uv;
        for (const glm::vec3& p : square.positions)
            uv.emplace_back((p.x + 1) / 2, (p.z + 1) / 2);
        file.add_vectors(square.positions);
        file.add_vectors(square.normals);
        file.add_accessor(file.add_view(GltfFile::bytes_of(uv)), 5126, 4, "VEC2");
        file.add_indices(square.indices);
        show(R"("POSITION":0,"NORMAL":1,"TEXCOORD_0":2)");
        file.add_node(R"({"mesh":0})");
        file.materials = {material};
        file.more = R"(,"images":[{"mimeType":"image/png","bufferView":)" + std::to_string(file.add_view(png)) +
                    R"(}],"samplers":[)" + sampler + R"(],"textures":[{"source":0,"sampler":0}])";
    }

    /// Makes the square of other attributes, as JSON without the braces.
    void show(const std::string& attributes) {
        file.meshes = {R"({"primitives":[{"attributes":{)" + attributes + R"(},"indices":3,"material":0}]})"};
    }

    template <class T = double>
    [[nodiscard]] examples::Scene<T> scene() const {
        return examples::scene_from<T>(parse(file)).scene;
    }
};

/// A diffuse material whose colour is the texture times (0.5, 1, 1).
///
/// @param more  properties of the texture's reference, each with a comma in front
[[nodiscard]] inline std::string painted_matt(const std::string& more = "") {
    return R"({"pbrMetallicRoughness":{"metallicFactor":0,"baseColorFactor":[0.5,1,1,1],)"
           R"("baseColorTexture":{"index":0)" +
           more + "}}}";
}

/// The hit of a ray that comes straight down from above (x, z).
template <class T>
[[nodiscard]] auto hit_below(const examples::Scene<T>& scene, double x, double z) {
    return scene.intersect({T(x), T(1), T(z)}, {T(0), T(-1), T(0)}, T(0), T(10)).value();
}

} // namespace nephroid::tests
