// SPDX-License-Identifier: MIT
/// @file  The pilot: finds the directions from which light comes, coarsely for tiles of the film and finely for blocks.
#pragma once

#include "common/path_tracer/film_layout.hpp"
#include "common/path_tracer/guide.hpp"
#include "common/path_tracer/paths.hpp"

#include "nephroid/sequence/random.hpp"

#include <functional>

namespace nephroid::examples {

/// An executor (execution/executor.hpp) of unknown kind.
using AnyExecutor = std::function<void(std::size_t, const std::function<void(std::size_t)>&)>;

/// The directions from which light comes, as far as known.
struct Guidance {
    DirectionGrid coarse{0}, fine{0};
    std::vector<CellSet> specular; ///< for each tile, in the coarse grid: cells in which specular surfaces are seen,
                                   ///< and their neighbours
    std::vector<CellSet> halo;     ///< the same for cells that would see light if the lights were larger
    std::vector<Guide> light;      ///< for each block, in the fine grid: cells with light, and those around
};

struct PilotOptions {
    unsigned paths_per_cell;  ///< of a tile, >= 1; blocks take half as many
    unsigned specular_events; ///< of a path, see `SpecularPaths`
    std::uint64_t seed;
};

/// Follows paths from all over the film into all cells, then into the parts of the cells with light, and so on. At
/// first the lights are enlarged, so that cells that see little of them are found as well.
///
/// The result only affects the noise of a picture and not its mean, so the pilot may miss rare light.
///
/// @return  the same for any executor
[[nodiscard]] Guidance explore(const BuiltinCase<double, double>& builtin, const FilmLayout& layout,
                               const PilotOptions& options, const AnyExecutor& executor);

/// A point of the rectangle, at height 0; u, v in [0, 1).
[[nodiscard]] inline Vec3<double> floor_point(const FilmRectangle& area, double u, double v) {
    return {area.x_min + u * (area.x_max - area.x_min), area.y_min + v * (area.y_max - area.y_min), 0};
}

} // namespace nephroid::examples
