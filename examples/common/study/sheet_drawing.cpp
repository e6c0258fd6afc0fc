// SPDX-License-Identifier: MIT
#include "common/study/sheet_drawing.hpp"

#include "common/stopwatch.hpp"
#include "common/study/bench.hpp"

#include "nephroid/sheet_caustics.hpp"

namespace nephroid::examples::study {

Estimate draw_sheets(const Bench& bench, const Photons& photons, double, Source) {
    constexpr double margin = 0.25; // light moves less than that from its place in a periodic case's patch
    const std::vector<FloorVertex> vertices = bench.vertices_with_ghosts(margin);
    Estimate result;
    Stopwatch stopwatch;
    const EyePathMap map(vertices, &FloorVertex::position, upwards,
                         [pixel = footprint_of(bench.film())](const FloorVertex&) { return pixel; });
    result.seconds.build = stopwatch.lap();
    auto sums = nephroid::sums<float>(map);
    TimingExecutor timing(bench.threads());
    static_cast<void>(sheet_caustics(bench.scene().scene_for_sheets(), bench.scene().light, sums,
                                     PhotonPass{.count = photons.emitted, .limits = bench.limits()}, {}, timing));
    result.seconds.trace = timing.trace_seconds();
    result.seconds.estimate = stopwatch.lap() - timing.trace_seconds();
    result.irradiance.resize(bench.film().pixels());
    const float share = 1 / static_cast<float>(bench.film().samples);
    sums.for_each([&](std::size_t vertex, float e) { result.irradiance[vertices[vertex].pixel] += share * e; });
    return result;
}

} // namespace nephroid::examples::study
