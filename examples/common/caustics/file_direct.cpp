// SPDX-License-Identifier: MIT
#include "common/caustics/file_layers.hpp"
#include "common/direct_light.hpp"

namespace nephroid::examples {

FileEyePaths see_file_scene(const FileScene& scene, const FileLamps& lamps, const Camera<float>& camera,
                            const Options& options, ThreadExecutor& threads) {
    Background<float, glm::vec3> background;
    if (!lamps.environments.empty())
        background = [&lamps](const glm::vec3& direction) { return lamps.background(direction); };
    return trace_eye_paths(scene, camera, {.samples = options.samples, .seed = options.seed}, threads, background);
}

std::vector<glm::vec3> direct_layer_of(const FileScene& scene, const FileLamps& lamps, const FileEyePaths& eye,
                                       const Options& options, ThreadExecutor& threads) {
    return direct_layer(scene, lamps, eye, {.seed = options.seed}, threads);
}

} // namespace nephroid::examples
