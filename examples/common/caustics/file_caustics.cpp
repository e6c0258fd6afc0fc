// SPDX-License-Identifier: MIT
#include "common/caustics/file_layers.hpp"
#include "common/caustics/render.hpp"
#include "common/photon_lights.hpp"

#include "nephroid/vector/glm.hpp"

namespace nephroid::examples {

void add_caustics_of(const FileScene& scene, const FileLamps& lamps, const FileEyePaths& eye, const FileMap& map,
                     const Options& options, ThreadExecutor& threads, Report& report, std::vector<glm::vec3>& pixels) {
    using Vertex = EyeVertex<float, glm::vec3>;
    const auto lights = photon_lights(lamps, scene);
    splat_caustics_timed<glm::vec3>(scene, lights, map, WalkLimits{}, options, false, threads, report,
                                    [&](std::size_t vertex, const glm::vec3& irradiance) {
                                        const Vertex& v = eye.vertices[vertex];
                                        pixels[v.pixel] += irradiance * v.weight;
                                    });
}

} // namespace nephroid::examples
