// SPDX-License-Identifier: MIT
/// @file  Fits the derivatives of the map to the photons in and around one cell of a path group.
#pragma once

#include "nephroid/smoothing/second_order/bending.hpp"
#include "nephroid/smoothing/second_order/field_options.hpp"
#include "nephroid/smoothing/second_order/group_cells.hpp"
#include "nephroid/smoothing/second_order/landings.hpp"
#include "nephroid/smoothing/second_order/map_kinks.hpp"
#include "nephroid/smoothing/second_order/roughness.hpp"
#include "nephroid/smoothing/second_order/smoothing_rule.hpp"
#include "nephroid/smoothing/second_order/tangent_jumps.hpp"
#include "nephroid/smoothing/second_order/tangent_scatter.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace nephroid::detail {

/// Fits the derivatives to the photons of this cell and of those around it, with a biweight about its middle.
///
/// @param cell   must have its frame; it becomes resolved if the photons determine the derivatives
/// @param share  of the photons that took this path (PhotonDensity)
inline void fit_derivatives(GroupCell& cell, const GroupCells& cells, const PathSamples& photons,
                            const FieldOptions& options, double share) {
    const EmissionCells& grid = cells.grid();
    const auto middle = grid.middle(cell.square);
    const Plane2 to_middle = cell.to_frame(grid.step_between(cell.frame_sample, middle));
    const double cell_area = std::abs(cell.to_frame.determinant()) / double(grid.size());
    const double reach2 = 1.44 * cell_area; // 1.2 cells
    std::vector<TangentResidual> here;
    Landings landings;
    PathFit fit;
    cells.for_each_around(cell, [&](const GroupCell& other, double) {
        for (const std::uint32_t i : grid.photons(other.square)) {
            const PathSample& photon = photons[i];
            if (!photon.frame.is_regular())
                continue;
            // Where the domain repeats, the frame does not know the shortest step to a photon, but the grid does.
            const Plane2 at = grid.repeats() ? cell.to_frame(grid.step_between(middle, photon.sample.at))
                                             : cell.frame.displacement_to(photon.frame) + -1.0 * to_middle;
            const double rest = 1 - inner(at, at) / reach2;
            if (!(rest > 0))
                continue;
            const auto& tangents = photon.tangents;
            if (!std::isfinite(inner(tangents[0], tangents[0]) + inner(tangents[1], tangents[1]) +
                               inner(photon.place, photon.place)))
                continue; // one invalid photon must not spoil its neighbours
            const PlaneMatrix axes = photon.frame.axes_of(cell.frame);
            const std::array<Double3, 2> by_axes{axes.first.x * tangents[0] + axes.first.y * tangents[1],
                                                 axes.second.x * tangents[0] + axes.second.y * tangents[1]};
            // Photons with longer tangents than the middle's weigh less: beside a pole of the map a few of them would
            // dominate the fit.
            const double size2 = inner(by_axes[0], by_axes[0]) + inner(by_axes[1], by_axes[1]);
            fit.add(at, by_axes, rest * rest * (cell.size2 > 0 ? cell.size2 / (cell.size2 + size2) : 0.5));
            landings.add(at, photon.place, by_axes, rest * rest);
            if (&other == &cell)
                here.push_back({{at.x, at.y, 0, 0}, by_axes, {}});
        }
    });
    cell.is_resolved = fit.solve(cell.map);
    if (!cell.is_resolved)
        return;
    cell.is_contradicted = !options.smoothing && landings.contradict(cell.map, options.largest_miss);
    for (TangentResidual& photon : here) {
        const auto fitted = tangents_at(cell.map, {photon.at[0], photon.at[1]});
        photon.residual = {photon.tangents[0] - fitted[0], photon.tangents[1] - fitted[1]};
    }
    const std::vector<TangentJump> jumps = tangent_jumps(here);
    cell.kinks = map_kinks(jumps);
    cell.scatter = tangent_scatter(here);
    const Symmetric2 q = bending(cell.map, options.photons, share, roughness(jumps), options.bounds.stretch);
    cell.log_q = log_bending(q, options.bounds);
    cell.is_resolved = cell.is_resolved && std::isfinite(cell.log_q.trace()) && std::isfinite(cell.log_q.xy);
}

} // namespace nephroid::detail
