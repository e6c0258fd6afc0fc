// SPDX-License-Identifier: MIT
/// @file  Where a sheet ends within the domain of its light, seen from each cell.
#pragma once

#include "nephroid/smoothing/second_order/sheet_cells.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace nephroid::detail {

/// Nothing but 0 comes of vectors that are too short to have a direction.
[[nodiscard]] inline Plane2 unit_or_zero(Plane2 v) {
    const double norm = std::sqrt(inner(v, v));
    return norm > 1e-6 ? (1 / norm) * v : Plane2{};
}

/// Whether the sheet ends in a cell or beside it, elsewhere than with the domain.
[[nodiscard]] inline bool ends_about(const SheetCell& cell, const SheetCells& cells) {
    bool ends = cell.is_next_to_border;
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
            if (const auto square = cells.grid().neighbour(cell.square, dx, dy)) {
                const SheetCell* other = cells.cell_in(*square);
                ends = ends || other == nullptr || !other->is_resolved;
            }
    return ends;
}

/// Lays the border of the sheet through or beside a cell: beyond the outermost of the photons about it, in the
/// direction where they are missing. All around the cell where they are missing on no side more than on another.
inline void lay_border(SheetCell& cell, const EmissionCells& grid, const PathSamples& photons) {
    const auto middle = grid.middle(cell.square);
    const double side = std::sqrt(std::abs(cell.metric.determinant()) / double(grid.size()));
    Plane2 of_photons{}, of_squares{};
    double squares = 0;
    std::vector<Plane2> places;
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
            if (const auto square = grid.neighbour(cell.square, dx, dy)) {
                of_squares = of_squares + cell.metric(grid.step_between(middle, grid.middle(*square)));
                squares += 1;
                for (const std::uint32_t i : grid.photons(*square)) {
                    places.push_back(cell.metric(grid.step_between(middle, photons[i].sample.at)));
                    of_photons = of_photons + places.back();
                }
            }
    const Plane2 missing = (1 / squares) * of_squares + (-1 / double(places.size())) * of_photons;
    cell.border_distance = 0.5 * side;
    if (!(inner(missing, missing) > square(0.1 * side)))
        return;
    const Plane2 outwards = unit_or_zero(missing), across{-outwards.y, outwards.x};
    double outermost = -1.5 * side;
    for (const Plane2 place : places)
        if (std::abs(inner(place, across)) < 0.5 * side)
            outermost = (std::max)(outermost, inner(place, outwards));
    cell.border_distance = outermost;
    cell.border_direction = outwards;
}

/// Between the middles of two cells, in the frame of the first.
[[nodiscard]] inline Plane2 displacement(const SheetCell& from, const SheetCell& to, const EmissionCells& grid) {
    return from.metric(grid.step_between(grid.middle(from.square), grid.middle(to.square)));
}

/// The distance and direction from each cell to where the sheet ends within the domain. Passed on from cell to cell,
/// no further than footprints reach.
///
/// @param largest_radius  of a footprint, in u0
inline void find_borders(SheetCells& cells, const PathSamples& photons, double largest_radius) {
    std::vector<std::uint32_t> border(cells.size(), SheetCells::nowhere), pending;
    for (std::uint32_t index = 0; index < cells.size(); ++index)
        if (cells[index].is_resolved && ends_about(cells[index], cells)) {
            lay_border(cells[index], cells.grid(), photons);
            border[index] = index;
            pending.push_back(index);
        }
    for (std::size_t next = 0; next < pending.size(); ++next) { // a queue: nearer borders arrive first, or replace
        const std::uint32_t from = border[pending[next]];
        cells.for_each_around(cells[pending[next]], [&](const SheetCell& other, double) {
            const std::uint32_t index = cells.index_of(other);
            if (!other.is_resolved || index == pending[next])
                return;
            const Plane2 away = displacement(other, cells[from], cells.grid());
            const double distance = cells[from].border_distance + std::sqrt(inner(away, away));
            const double known = other.border_distance;
            if ((std::isfinite(known) && !(distance < known - 1e-9 * std::abs(known))) || distance > largest_radius)
                return;
            cells[index].border_distance = distance;
            cells[index].border_direction = unit_or_zero(away);
            border[index] = from;
            pending.push_back(index);
        });
    }
}

} // namespace nephroid::detail
