// SPDX-License-Identifier: MIT
#include "common/caustics/file_layers.hpp"
#include "common/caustics/interrupt.hpp"
#include "common/caustics/progress.hpp"
#include "common/stopwatch.hpp"
#include "common/unaimed_lights.hpp"

#include "nephroid/bounce/splat_global.hpp"
#include "nephroid/gather/shrinking_radius.hpp"
#include "nephroid/vector/glm.hpp"

#include <optional>
#include <stdexcept>
#include <variant>

namespace nephroid::examples {

FileLayer indirect_layer_of(const FileScene& scene, const FileLamps& lamps, const FileEyePaths& eye, const FileMap& map,
                            const Options& options, unsigned bounces, ThreadExecutor& threads, Report& report) {
    Stopwatch stopwatch;
    const auto lights = unaimed_lights(lamps, scene);
    if (!(lights.power() > 0))
        throw std::runtime_error("the lights emit nothing: their intensity or emission is zero");
    const FreeDistances<glm::vec3> distances(map, scene, {}, threads);
    auto sums = nephroid::sums<glm::vec3>(map);
    const std::uint64_t count = options.emit.value_or(options.photons);
    GlobalPass pass{.count = count};
    pass.limits.diffuse_bounces = bounces;
    std::optional<ShrinkingRadius> radius; // so that the mean of passes converges, as that of `illuminate` does
    const auto splat_pass = [&](const auto& sequence) {
        const GlobalSplats splats = splat_global(scene, lights, sums, distances, pass, sequence, threads);
        if (const auto first = splats.radius_of_later_passes(); first && !radius)
            radius.emplace(ShrinkingRadiusOptions{*first});
        if (radius) {
            radius->advance();
            pass.radius = radius->radius();
        }
        if (report.indirect)
            *report.indirect += splats;
        else
            report.indirect = splats;
        return splats.statistics.emitted.photons;
    };
    FileLayer layer = std::visit(
        [&](const auto& sequence) {
            return trace_passes(
                options.error, count,
                [&](std::uint64_t first) {
                    Progress progress(count);
                    pass.progress = [&](std::uint64_t done) {
                        progress.show(done);
                        return !is_interrupted();
                    };
                    sums.clear();
                    pass.first = first;
                    return splat_pass(sequence);
                },
                [&] { return pixels_of(sums, eye, options); });
        },
        make_sequence(options.sequence, options.seed));
    report.indirect_passes = layer.report;
    divide_flux(report.indirect->statistics, layer.report.passes);
    report.interrupted = report.interrupted || layer.report.is_interrupted;
    report.seconds.indirect = stopwatch.lap();
    return layer;
}

} // namespace nephroid::examples
