// SPDX-License-Identifier: MIT
/// @file  A path traced reference for caustics without an exact solution, with a standard error.
#pragma once

#include "common/builtin_cases.hpp"
#include "common/path_tracer/pilot.hpp"

#include "nephroid/execution/executor.hpp"

#include <cstdint>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace nephroid::examples {

struct PathTraceOptions {
    std::uint64_t samples = 4096; ///< paths from each pixel, rounded up to whole passes, >= 1
    double seconds =
        std::numeric_limits<double>::infinity(); ///< no pass begins after this time, except for the first two
    unsigned samples_per_pass = 16;              ///< >= 4, <= 65536. A pass is one estimate of the picture
    unsigned specular_events = 1u << 16;         ///< longer paths are left out, as photons are with such a limit
    unsigned pilot = 4;                          ///< paths into each cell of directions during the pilot, >= 1
    unsigned rehearsals = 64; ///< passes before the first one that counts; all their samples look for light
                              ///< where none is expected
    std::uint64_t seed = 0;
};

/// The irradiance on the floor by light that met a specular surface, pixel by pixel, row 0 with the smallest y.
struct PathTracedReference {
    std::vector<double> mean;
    std::vector<double> standard_error; ///< of the mean, from how much the passes differ; infinite after one pass
    std::uint64_t samples = 0;          ///< paths from each pixel. Pixels for which the pilot saw no light take a
                                        ///< quarter of them
};

/// Called after each pass, from the calling thread, with the picture so far; false ends it.
using PathTraceProgress = std::function<bool(const PathTracedReference&)>;

/// Computes a picture of a built-in case, or of any scene above the floor z = 0 whose lights have area, by
/// unidirectional path tracing, unbiased: from points spread over each pixel into directions above the floor, through
/// mirrors and glass, to what of the light is hit.
///
/// Directions are drawn from several densities at once and weighted by their sum (the balance heuristic of Veach and
/// Guibas 1995): most over small cells of directions in which a pilot or earlier passes saw light from nearby; some
/// over larger cells around those; some over all directions in which specular surfaces are seen; some over all
/// directions, uniform in projected solid angle. The last ones make the estimate unbiased. Light that only they find is
/// noise, which the standard error shows; for a pixel with too few such finds, the standard error is too small.
/// Therefore there are rehearsals: passes that only look for light, and do not count.
///
/// The result is the same bit for bit for any number of threads; it depends on the clock only through `seconds`.
/// Throws std::invalid_argument for a film or options out of range, for a case with a light that has no area (no path
/// meets it), and for parts of glass whose bounds overlap (paths do not know media within media). Not checked: that one
/// mesh does not have glass within glass, and that surfaces do not touch.
[[nodiscard]] PathTracedReference path_trace_reference(const BuiltinCase<double, double>& builtin, std::size_t width,
                                                       std::size_t height, const PathTraceOptions& options,
                                                       const AnyExecutor& executor,
                                                       const PathTraceProgress& progress = {});

/// With an executor of any kind.
template <Executor E>
[[nodiscard]] PathTracedReference path_trace_reference(const BuiltinCase<double, double>& builtin, std::size_t width,
                                                       std::size_t height, const PathTraceOptions& options, E& executor,
                                                       const PathTraceProgress& progress = {}) {
    const AnyExecutor any = [&executor](std::size_t count, const std::function<void(std::size_t)>& task) {
        executor(count, task);
    };
    return path_trace_reference(builtin, width, height, options, any, progress);
}

} // namespace nephroid::examples
