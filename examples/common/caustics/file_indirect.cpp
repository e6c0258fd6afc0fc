// SPDX-License-Identifier: MIT
#include "common/caustics/file_layers.hpp"
#include "common/caustics/interrupt.hpp"
#include "common/caustics/progress.hpp"
#include "common/stopwatch.hpp"
#include "common/unaimed_lights.hpp"

#include "nephroid/bounce/splat_global.hpp"
#include "nephroid/vector/glm.hpp"

#include <stdexcept>
#include <variant>

namespace nephroid::examples {

void add_indirect_of(const FileScene& scene, const FileLamps& lamps, const FileEyePaths& eye, const FileMap& map,
                     const Options& options, unsigned bounces, ThreadExecutor& threads, Report& report,
                     std::vector<glm::vec3>& pixels) {
    Stopwatch stopwatch;
    const auto lights = unaimed_lights(lamps, scene);
    if (!(lights.power() > 0))
        throw std::runtime_error("the lights emit nothing: their intensity or emission is zero");
    const FreeDistances<glm::vec3> distances(map, scene, {}, threads);
    auto sums = nephroid::sums<glm::vec3>(map);
    const std::uint64_t count = options.emit.value_or(options.photons);
    Progress progress(count);
    GlobalPass pass{.count = count, .progress = [&](std::uint64_t done) {
                        progress.show(done);
                        return !is_interrupted();
                    }};
    pass.limits.diffuse_bounces = bounces;
    std::visit(
        [&](const auto& sequence) {
            report.indirect = splat_global(scene, lights, sums, distances, pass, sequence, threads);
        },
        make_sequence(options.sequence, options.seed));
    const std::uint64_t emitted = report.indirect->statistics.emitted.photons;
    report.interrupted = report.interrupted || emitted < count;
    const float share = emitted > 0 ? float(double(count) / double(emitted)) : 0; // fewer stand for all of the light
    sums.for_each([&](std::size_t vertex, const glm::vec3& irradiance) {
        pixels[eye.vertices[vertex].pixel] += irradiance * eye.vertices[vertex].weight * share;
    });
    report.seconds.indirect = stopwatch.lap();
}

} // namespace nephroid::examples
