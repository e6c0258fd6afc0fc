// SPDX-License-Identifier: MIT
/// @file  Fits the derivatives of the map to the photons in and around one cell of an area light's domain.
#pragma once

#include "nephroid/smoothing/second_order/area_fit.hpp"
#include "nephroid/smoothing/second_order/area_grid.hpp"
#include "nephroid/smoothing/second_order/area_photons.hpp"
#include "nephroid/smoothing/second_order/bending.hpp"
#include "nephroid/smoothing/second_order/field_options.hpp"
#include "nephroid/smoothing/second_order/smoothing_rule.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace nephroid::detail {

[[nodiscard]] inline double length2_of(const AreaSample& v) {
    return v[0] * v[0] + v[1] * v[1] + (v[2] * v[2] + v[3] * v[3]);
}

/// Chooses the path that the cell describes, and the photon whose frame the cell uses. The cell gets no frame if none
/// of its photons is usable.
inline void choose_frame(AreaCell& cell, std::size_t index, const AreaCells& grid, const AreaPhotons& photons) {
    const auto signature = photons.commonest_path(grid.photons(index));
    if (!signature)
        return;
    cell.signature = *signature;
    cell.has_frame = true;
    double nearest = std::numeric_limits<double>::infinity();
    for (const std::uint32_t i : grid.photons(index)) {
        if (!photons.is_usable_on(i, cell.signature))
            continue;
        const double distance2 = length2_of(grid.from_middle(index, photons.samples()[i], false));
        if (distance2 < nearest) {
            nearest = distance2;
            cell.frame = photons[i].frame;
        }
    }
}

/// Fits the derivatives to the photons of this cell and of those around it, with a biweight about its middle.
inline void fit_derivatives(AreaCell& cell, std::size_t index, const AreaCells& grid, const AreaPhotons& photons,
                            const FieldOptions& options) {
    if (!cell.has_frame)
        return;
    constexpr double reach = 1.2; // cells
    AreaFit fit;
    grid.for_each_around(index, [&](const std::array<int, 4>&, std::size_t other) {
        if (other == grid.size())
            return;
        for (const std::uint32_t i : grid.photons(other)) {
            const double rest = 1 - length2_of(grid.from_middle(index, photons.samples()[i], true)) / square(reach);
            if (!(rest > 0) || !photons.is_usable_on(i, cell.signature))
                continue;
            AreaSample away = grid.from_middle(index, photons.samples()[i], false);
            for (std::size_t axis = 0; axis < 4; ++axis)
                away[axis] /= double(grid.counts()[axis]);
            fit.add(cell.frame.step_to(photons[i].frame),
                    rotated(photons[i].tangents, cell.frame.rotation_of(photons[i].frame)), away, rest * rest);
        }
    });
    double rough = 0;
    if (!fit.solve(cell.map, cell.samples_by_step, rough))
        return;
    cell.log_q = log_bending(slice_bending(cell.map, options.photons, rough), options.bounds);
    cell.is_resolved = std::isfinite(cell.log_q.trace()) && std::isfinite(cell.log_q.xy);
}

} // namespace nephroid::detail
