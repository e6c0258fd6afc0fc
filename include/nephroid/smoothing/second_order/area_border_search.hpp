// SPDX-License-Identifier: MIT
/// @file  The border nearest to each cell of an area light's domain, passed from cell to cell.
#pragma once

#include "nephroid/smoothing/second_order/area_border.hpp"
#include "nephroid/smoothing/second_order/area_grid.hpp"
#include "nephroid/smoothing/second_order/area_photons.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace nephroid::detail {

/// Gives a cell a border if it is nearer than the one that the cell has, and within reach.
///
/// @param largest_radius  of a footprint, in u0: borders further away than this do not matter
/// @return  whether the cell got the border
[[nodiscard]] inline bool set_nearer_border(AreaCell& cell, const AreaBorder& border, const AreaCells& grid,
                                            double largest_radius) {
    Plane2 by_step{}; // how fast a step along the tangents approaches the border
    for (std::size_t axis = 0; axis < 4; ++axis)
        by_step = by_step + border.outwards[axis] * double(grid.counts()[axis]) * cell.samples_by_step[axis];
    const double speed = std::sqrt(inner(by_step, by_step));
    const double distance = (std::max)(0.0, border.distance) / speed;
    if (!(distance < (1 - 1e-9) * cell.border_distance) || distance > largest_radius)
        return false;
    cell.border_distance = distance;
    cell.border_direction = (1 / speed) * by_step;
    return true;
}

/// Finds the border in or beside a cell, if there is one.
inline void find_border(AreaCell& cell, std::size_t index, const AreaCells& grid, const AreaPhotons& photons,
                        double largest_radius) {
    if (!cell.is_resolved)
        return;
    cell.border =
        border_near(grid, index, photons.samples(), [&](std::uint32_t i) { return photons.is_on(i, cell.signature); });
    if (cell.border && !set_nearer_border(cell, *cell.border, grid, largest_radius))
        cell.border.reset();
}

/// Passes borders from the cells that they cross to all cells whose footprints reach them.
inline void propagate_borders(AreaGrid& area, double largest_radius) {
    std::vector<std::size_t> source(area.cells.size()), pending;
    for (std::size_t index = 0; index < area.cells.size(); ++index)
        if (area.cells[index].border) {
            source[index] = index;
            pending.push_back(index);
        }
    // A queue: near borders arrive first, and a nearer one that arrives later replaces them.
    for (std::size_t next = 0; next < pending.size(); ++next) {
        const std::size_t from = pending[next], at = source[from];
        area.grid.for_each_around(from, [&](const std::array<int, 4>&, std::size_t to) {
            if (to == area.grid.size() || to == from || !area.are_linked(from, to))
                return;
            const AreaBorder seen =
                area.cells[at].border->seen_from(area.grid.coordinates_of(at), area.grid.coordinates_of(to));
            if (seen.distance > 0 && set_nearer_border(area.cells[to], seen, area.grid, largest_radius)) {
                source[to] = at;
                pending.push_back(to);
            }
        });
    }
}

} // namespace nephroid::detail
