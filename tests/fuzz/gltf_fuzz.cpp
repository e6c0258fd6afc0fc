// SPDX-License-Identifier: MIT
/// @file  Feeds the glTF reader with whatever libFuzzer thinks of, and what it reads to the scene that is made of it.
#include "common/scene_from_gltf.hpp"

#include "nephroid/vector/glm.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace nephroid::examples;
    try {
        const SceneDescription description = parse_gltf({data, size}, "fuzz.glb");
        for (const MeshDescription& mesh : description.meshes)
            for (const auto& triangle : mesh.triangles)
                for (const std::uint32_t vertex : triangle)
                    if (vertex >= mesh.positions.size() || mesh.material >= description.materials.size())
                        std::abort();
        const auto scene = scene_from<float>(description).scene;
        const auto hit = scene.intersect({0.1f, 0.2f, 9}, {0, 0, -1}, 0, 1e9f); // looks up textures
        if (hit && !(scene.coverage(*hit) >= 0 && scene.transmission(*hit) >= 0 && scene.color(*hit).x >= 0))
            std::abort();
    } catch (const std::runtime_error&) {
        // refused by the reader, with a message
    } catch (const std::invalid_argument&) {
        // refused by the scene, with a message
    }
    return 0;
}
