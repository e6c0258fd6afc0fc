// SPDX-License-Identifier: MIT
#include "common/caustics/file_layers.hpp"
#include "common/stopwatch.hpp"
#include "common/unaimed_lights.hpp"

#include "nephroid/bounce/illumination.hpp"
#include "nephroid/bounce/splat_global.hpp"
#include "nephroid/vector/glm.hpp"

#include <stdexcept>
#include <utility>
#include <variant>

namespace nephroid::examples {

FileLayer indirect_layer_of(const FileScene& scene, const FileLamps& lamps, const FileEyePaths& eye, const FileMap& map,
                            const Options& options, unsigned bounces, ThreadExecutor& threads, Report& report) {
    Stopwatch stopwatch;
    const auto lights = unaimed_lights(lamps, scene);
    if (!(lights.power() > 0))
        throw std::runtime_error("the lights emit nothing: their intensity or emission is zero");
    Illumination<glm::vec3, glm::vec3> light(map, scene, {}, threads);
    const std::uint64_t count = options.emit.value_or(options.photons);
    GlobalPass pass{.count = count};
    pass.limits.diffuse_bounces = bounces;
    FileLayer layer = std::visit(
        [&](const auto& sequence) {
            return trace_passes(
                options.error, count,
                [&](std::uint64_t first, const auto& progress) {
                    light.indirect().clear();
                    pass.first = first;
                    pass.radius = light.radius(); // it shrinks, so that the mean of the passes converges
                    pass.progress = progress;
                    const GlobalSplats splats =
                        splat_global(scene, lights, light.indirect(), light.distances(), pass, sequence, threads);
                    light.end_indirect_pass(count, splats.radius_of_later_passes(), 2.0 / 3);
                    if (report.indirect)
                        *report.indirect += splats;
                    else
                        report.indirect = splats;
                    return splats.statistics.emitted.photons;
                },
                [&] { return pixels_of(std::as_const(light).indirect(), eye, options); });
        },
        make_sequence(options.sequence, options.seed));
    report.indirect_passes = layer.report;
    divide_flux(report.indirect->statistics, layer.report.passes);
    report.interrupted = report.interrupted || layer.report.is_interrupted;
    report.seconds.indirect = stopwatch.lap();
    return layer;
}

} // namespace nephroid::examples
