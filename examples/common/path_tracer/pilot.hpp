// SPDX-License-Identifier: MIT
/// @file  Finding out where light comes from, before a picture is taken: coarsely for tiles of the film, finely for
/// blocks.
#pragma once

#include "common/path_tracer/film_layout.hpp"
#include "common/path_tracer/guide.hpp"
#include "common/path_tracer/paths.hpp"

#include "nephroid/sequence/random.hpp"

#include <functional>

namespace nephroid::examples {

/// An executor (execution/executor.hpp) of unknown kind.
using AnyExecutor = std::function<void(std::size_t, const std::function<void(std::size_t)>&)>;

/// What is known of where light comes from.
struct Guidance {
    DirectionGrid coarse{0}, fine{0};
    std::vector<CellSet> specular; ///< for each tile, in the coarse grid: cells with anything specular to be seen, and
                                   ///< those around
    std::vector<CellSet> halo;     ///< the same for cells with light, had the lights been larger than they are
    std::vector<Guide> light;      ///< for each block, in the fine grid: cells with light, and those around
};

struct PilotOptions {
    unsigned paths_per_cell;  ///< of a tile, >= 1; blocks take half as many
    unsigned specular_events; ///< of a path, see `SpecularPaths`
    std::uint64_t seed;
};

/// Follows paths from all over the film into all cells, then into the parts of those cells where light is, and so on.
/// At first the lights are made larger than they are, so that what sees little of them is found as well.
///
/// What it finds makes no picture right or wrong, only less noisy: it may miss what is rare.
///
/// @return  the same for any executor
[[nodiscard]] Guidance explore(const BuiltinCase<double, double>& builtin, const FilmLayout& layout,
                               const PilotOptions& options, const AnyExecutor& executor);

/// A point of the rectangle, at height 0; u, v in [0, 1).
[[nodiscard]] inline Vec3<double> floor_point(const FilmRectangle& area, double u, double v) {
    return {area.x_min + u * (area.x_max - area.x_min), area.y_min + v * (area.y_max - area.y_min), 0};
}

} // namespace nephroid::examples
