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
        static_cast<void>(scene_from<float>(description));
    } catch (const std::runtime_error&) {
        // refused by the reader, with a message
    } catch (const std::invalid_argument&) {
        // refused by the scene, with a message
    }
    return 0;
}
