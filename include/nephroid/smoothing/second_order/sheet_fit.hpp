// SPDX-License-Identifier: MIT
/// @file  Derivatives of the map over one cell of a sheet, and how much it bends there.
#pragma once

#include "nephroid/smoothing/second_order/bending.hpp"
#include "nephroid/smoothing/second_order/field_options.hpp"
#include "nephroid/smoothing/second_order/roughness.hpp"
#include "nephroid/smoothing/second_order/sheet_cells.hpp"
#include "nephroid/smoothing/second_order/smoothing_rule.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace nephroid::detail {

/// Fits the derivatives to the photons of this cell and those around it, weighted by a biweight about its middle.
///
/// @param cell   must have its frame; it is resolved if the photons suffice
/// @param share  of the light's photons that chance sent on this path (PhotonDensity)
inline void fit_derivatives(SheetCell& cell, const SheetCells& cells, const PathSamples& photons,
                            const FieldOptions& options, double share) {
    const EmissionCells& grid = cells.grid();
    const auto middle = grid.middle(cell.square);
    const Plane2 to_middle = cell.metric(grid.step_between(cell.frame_sample, middle));
    const double cell_area = std::abs(cell.metric.determinant()) / double(grid.size());
    const double reach2 = 1.44 * cell_area; // 1.2 cells
    std::vector<TangentResidual> here;
    PathFit fit;
    cells.for_each_around(cell, [&](const SheetCell& other, double) {
        for (const std::uint32_t i : grid.photons(other.square)) {
            const PathSample& photon = photons[i];
            if (!photon.frame.is_regular())
                continue;
            // A repeated domain's photons lie where a step leads to, not where they were emitted.
            const Plane2 at = grid.repeats() ? cell.metric(grid.step_between(middle, photon.sample.at))
                                             : cell.frame.to(photon.frame) + -1.0 * to_middle;
            const double rest = 1 - inner(at, at) / reach2;
            if (!(rest > 0))
                continue;
            const auto& tangents = photon.tangents;
            if (!std::isfinite(inner(tangents[0], tangents[0]) + inner(tangents[1], tangents[1])))
                continue; // will be an invalid splat, and must not be its neighbours' end
            const PlaneMatrix axes = photon.frame.axes_of(cell.frame);
            const std::array<Space3, 2> by_axes{axes.first.x * tangents[0] + axes.first.y * tangents[1],
                                                axes.second.x * tangents[0] + axes.second.y * tangents[1]};
            // By its own measure where that is larger than the middle's: beside a pole of the map a few photons would
            // else decide for all.
            const double size2 = inner(by_axes[0], by_axes[0]) + inner(by_axes[1], by_axes[1]);
            fit.add(at, by_axes, rest * rest * (cell.size2 > 0 ? cell.size2 / (cell.size2 + size2) : 0.5));
            if (&other == &cell)
                here.push_back({{at.x, at.y, 0, 0}, by_axes, {}});
        }
    });
    cell.is_resolved = fit.solve(cell.map);
    if (!cell.is_resolved)
        return;
    for (TangentResidual& photon : here) {
        const auto fitted = tangents_at(cell.map, {photon.at[0], photon.at[1]});
        photon.unexplained = {photon.tangents[0] - fitted[0], photon.tangents[1] - fitted[1]};
    }
    const Symmetric2 q = bending(cell.map, options.photons, share, roughness(here), options.bounds.stretch);
    cell.log_q = log_bending(q, options.bounds);
    cell.is_resolved = cell.is_resolved && std::isfinite(cell.log_q.trace()) && std::isfinite(cell.log_q.xy);
}

} // namespace nephroid::detail
