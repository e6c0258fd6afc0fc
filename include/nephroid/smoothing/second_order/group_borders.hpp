// SPDX-License-Identifier: MIT
/// @file  The distance and direction from each cell to the border of its path group.
#pragma once

#include "nephroid/smoothing/second_order/group_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace nephroid::detail {

/// The unit vector of the same direction; 0 if the vector is too short to have one.
[[nodiscard]] inline Plane2 unit_or_zero(Plane2 v) {
    const double norm = std::sqrt(inner(v, v));
    return norm > 1e-6 ? (1 / norm) * v : Plane2{};
}

/// The side of a cell in its frame, u0: the root of its area.
[[nodiscard]] inline double side_of(const GroupCell& cell, const EmissionCells& grid) {
    return std::sqrt(std::abs(cell.to_frame.determinant()) / double(grid.size()));
}

/// Whether the group's border lies in a cell or beside it. The border of the domain does not count.
[[nodiscard]] inline bool has_border_nearby(const GroupCell& cell, const GroupCells& cells) {
    bool ends = cell.has_border;
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
            if (const auto square = cells.grid().neighbour(cell.square, dx, dy)) {
                const GroupCell* other = cells.cell_in(*square);
                ends = ends || other == nullptr || !other->is_resolved;
            }
    return ends;
}

/// Sets the border of the group in or beside a cell: at the outermost photon nearby, in the direction in which photons
/// are missing. If as many are missing in every direction, the border gets no direction and lies half a cell away.
inline void mark_border(GroupCell& cell, const EmissionCells& grid, const PathSamples& photons) {
    const auto middle = grid.middle(cell.square);
    const double side = side_of(cell, grid);
    Plane2 sum_of_photons{}, sum_of_squares{};
    double squares = 0;
    std::vector<Plane2> positions;
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
            if (const auto square = grid.neighbour(cell.square, dx, dy)) {
                sum_of_squares = sum_of_squares + cell.to_frame(grid.step_between(middle, grid.middle(*square)));
                squares += 1;
                for (const std::uint32_t i : grid.photons(*square)) {
                    positions.push_back(cell.to_frame(grid.step_between(middle, photons[i].sample.at)));
                    sum_of_photons = sum_of_photons + positions.back();
                }
            }
    const Plane2 missing = (1 / squares) * sum_of_squares + (-1 / double(positions.size())) * sum_of_photons;
    cell.border_distance = 0.5 * side;
    if (!(inner(missing, missing) > square(0.1 * side)))
        return;
    const Plane2 outwards = unit_or_zero(missing), across{-outwards.y, outwards.x};
    double outermost = -1.5 * side;
    for (const Plane2 position : positions)
        if (std::abs(inner(position, across)) < 0.5 * side)
            outermost = (std::max)(outermost, inner(position, outwards));
    cell.border_distance = outermost;
    cell.border_direction = outwards;
}

/// The displacement between the middles of two cells, in the frame of the first.
[[nodiscard]] inline Plane2 displacement(const GroupCell& from, const GroupCell& to, const EmissionCells& grid) {
    return from.to_frame(grid.step_between(grid.middle(from.square), grid.middle(to.square)));
}

/// Finds the group's border for each cell. Borders are passed from cell to cell.
inline void find_borders(GroupCells& cells, const PathSamples& photons) {
    std::vector<std::uint32_t> border(cells.size(), GroupCells::no_cell), pending;
    for (std::uint32_t index = 0; index < cells.size(); ++index)
        if (cells[index].is_resolved && has_border_nearby(cells[index], cells)) {
            mark_border(cells[index], cells.grid(), photons);
            border[index] = index;
            pending.push_back(index);
        }
    // A queue: near borders arrive first, and a nearer one that arrives later replaces them.
    for (std::size_t next = 0; next < pending.size(); ++next) {
        const std::uint32_t from = border[pending[next]];
        cells.for_each_around(cells[pending[next]], [&](const GroupCell& other, double) {
            const std::uint32_t index = cells.index_of(other);
            if (!other.is_resolved || index == pending[next])
                return;
            const Plane2 away = displacement(other, cells[from], cells.grid());
            const double distance = cells[from].border_distance + std::sqrt(inner(away, away));
            const double known = other.border_distance;
            if (std::isfinite(known) && !(distance < known - 1e-9 * std::abs(known)))
                return;
            cells[index].border_distance = distance;
            cells[index].border_direction = unit_or_zero(away);
            border[index] = from;
            pending.push_back(index);
        });
    }
}

/// A point of the border of a cell that has one in or beside it, in emission coordinates.
[[nodiscard]] inline std::optional<std::array<double, 2>> border_point(const GroupCell& cell,
                                                                       const EmissionCells& grid) {
    if (!std::isfinite(cell.border_distance) || !(std::abs(cell.to_frame.determinant()) > 0))
        return std::nullopt;
    const auto middle = grid.middle(cell.square);
    const Plane2 step = cell.to_frame.inverse()(cell.border_distance * cell.border_direction);
    return std::array<double, 2>{middle[0] + step.x, middle[1] + step.y};
}

/// Finds how far a cell is from the group's border in one direction.
///
/// @param direction  unit, in the cell's frame
/// @return  infinity towards the border of the domain
[[nodiscard]] inline double distance_to_border(const GroupCell& cell, const GroupCells& cells, Plane2 direction) {
    constexpr double endless = std::numeric_limits<double>::infinity();
    const EmissionCells& grid = cells.grid();
    const auto middle = grid.middle(cell.square);
    const Plane2 by_unit = cell.to_frame.inverse()(direction);
    // Half a cell at most along either coordinate, so that none is jumped over.
    const double step =
        0.5 / (std::max)(std::abs(by_unit.x) * double(grid.columns()), std::abs(by_unit.y) * double(grid.rows()));
    if (!(step > 0) || !std::isfinite(step))
        return endless; // the frame is singular here
    const double side = 2 * step;
    const double furthest = 2 * step * double(grid.columns() + grid.rows());
    const GroupCell* last = &cell;
    for (double at = step; at <= furthest; at += step) {
        std::array<double, 2> sample{middle[0] + at * by_unit.x, middle[1] + at * by_unit.y};
        for (double& u : sample) {
            if (grid.repeats())
                u -= std::floor(u);
            if (!(u >= 0 && u < 1))
                return endless;
        }
        const GroupCell* here = cells.cell_in(grid.cell_of(sample));
        if (here != nullptr && here->is_resolved) {
            last = here;
            continue;
        }
        // The border is where the last cell marked it, if it did, and otherwise between that cell and this square.
        const double between = at - step;
        if (const auto border = border_point(*last, grid)) {
            const double found = inner(direction, cell.to_frame(grid.step_between(middle, *border)));
            return std::clamp(found, between - side, between + step);
        }
        return between;
    }
    return endless;
}

/// Finds for each cell with a border a second one, in a direction perpendicular to the first. Both bound the footprints
/// in a corner of the group, and in a group that is narrower than a footprint.
inline void find_borders_across(GroupCells& cells) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
        GroupCell& cell = cells[i];
        if (!cell.is_resolved || !std::isfinite(cell.border_distance) ||
            !(inner(cell.border_direction, cell.border_direction) > 0))
            continue;
        for (const double side : {1.0, -1.0}) {
            const Plane2 across{-side * cell.border_direction.y, side * cell.border_direction.x};
            const double distance = distance_to_border(cell, cells, across);
            if (distance < cell.across_distance) {
                cell.across_distance = distance;
                cell.across_direction = across;
            }
        }
    }
}

} // namespace nephroid::detail
