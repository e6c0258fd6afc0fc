// SPDX-License-Identifier: MIT
/// @file  The same as render.hpp with light sheets: from a scene, a light and an eye path map to sums at the vertices.
#pragma once

#include "common/caustic_photons.hpp"
#include "common/caustics/passes.hpp"
#include "common/caustics/report.hpp"
#include "common/stopwatch.hpp"

#include "nephroid/sheet_caustics.hpp"

#include <stdexcept>
#include <type_traits>
#include <utility>

namespace nephroid::examples {

/// Draws the sheets that the options ask for, and splats the light that lies on none. An interrupt ends the splats, and
/// no further pass begins.
///
/// @param map        best with pixel footprints
/// @param pixels_of  pixels_of(sums) -> the layer's pixels
/// @return  a PassedLayer
template <Flux F, class S, Light L, Vector3 V, class PixelsOf>
auto draw_sheets_timed(const S& scene, const L& light, const EyePathMap<V>& map, const WalkLimits& limits,
                       const Options& options, ThreadExecutor& threads, Report& report, const PixelsOf& pixels_of) {
    if (!(light.power() > 0))
        throw std::runtime_error("the lights emit nothing: their intensity or emission is zero");
    Stopwatch stopwatch;
    PhotonPass pass{.limits = limits};
    pass.count =
        options.emit ? *options.emit : emit_for(scene, light, options.photons, limits, HaltonSequence(), threads);
    report.seconds.pilot += stopwatch.lap();

    TimingExecutor timing(threads);
    auto sums = nephroid::sums<F>(map);
    SheetReport& sheets = report.sheets.emplace();
    auto layer = trace_passes(
        options.error, pass.count,
        [&](std::uint64_t first, const auto& progress) {
            sums.clear();
            pass.first = first;
            bool goes_on = true;
            pass.progress = [&](std::uint64_t) { return goes_on = !is_interrupted(); };
            const SheetsAndSplats drawn = sheet_caustics(scene, light, sums, pass, {}, timing);
            report.statistics += drawn.sheets.light;
            sheets.account += drawn.sheets.sheets;
            sheets.unresolved += drawn.sheets.unresolved;
            sheets.splats += drawn.splats;
            (void)progress(pass.count);
            return goes_on ? pass.count : 0;
        },
        [&] { return pixels_of(std::as_const(sums)); });
    report.seconds.trace += timing.trace_seconds();
    report.seconds.fit += timing.fit_seconds();
    report.seconds.splat += timing.splat_seconds();
    report.caustic_passes = layer.report;
    divide_flux(report.statistics, layer.report.passes);
    report.interrupted = report.interrupted || layer.report.is_interrupted;
    return layer;
}

} // namespace nephroid::examples
