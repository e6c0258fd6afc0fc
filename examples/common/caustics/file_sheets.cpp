// SPDX-License-Identifier: MIT
#include "common/caustics/file_layers.hpp"
#include "common/caustics/render_sheets.hpp"
#include "common/photon_lights.hpp"

#include "nephroid/vector/glm.hpp"

namespace nephroid::examples {

FileLayer sheet_layer_of(const FileScene& scene, const FileLamps& lamps, const FileEyePaths& eye, const FileMap& map,
                         const Options& options, ThreadExecutor& threads, Report& report) {
    const auto lights = photon_lights(lamps, scene);
    return draw_sheets_timed<glm::vec3>(scene, lights, map, WalkLimits{}, options, threads, report,
                                        [&](const auto& sums) { return pixels_of(sums, eye, options); });
}

} // namespace nephroid::examples
