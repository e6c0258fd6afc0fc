// SPDX-License-Identifier: MIT
/// @file  How steps between the samples of a sheet's photons become displacements in the frame of one of them.
#pragma once

#include "nephroid/smoothing/second_order/sheet_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace nephroid::detail {

/// Which pair of the square's triangles a sample lies in. A concentric map of the square onto a disk has a kink along
/// its diagonals.
[[nodiscard]] inline std::size_t side_of(const std::array<double, 2>& sample) {
    return std::abs(sample[0] - 0.5) > std::abs(sample[1] - 0.5) ? 0 : 1;
}

/// The metric by those photons of a cell and of those around it that lie on one side of a diagonal; that of the cell
/// if no diagonal passes through it.
[[nodiscard]] inline PlaneMatrix metric_on_side(const SheetCell& cell, const SheetCells& cells,
                                                const PathSamples& photons, std::size_t side) {
    const EmissionCells& grid = cells.grid();
    const auto is_here = [&](std::uint32_t i) { return side_of(photons[i].sample.at) == side; };
    const auto inside = grid.photons(cell.square);
    if (std::all_of(inside.begin(), inside.end(), is_here) || std::none_of(inside.begin(), inside.end(), is_here))
        return cell.metric;
    Plane2 step_sum{}, place_sum{};
    double weights = 0;
    const auto for_each = [&](const auto& visit) {
        cells.for_each_around(cell, [&](const SheetCell& other, double weight) {
            for (const std::uint32_t i : grid.photons(other.square))
                if (is_here(i))
                    visit(grid.step_between(cell.frame_sample, photons[i].sample.at), cell.frame.to(photons[i].frame),
                          weight);
        });
    };
    for_each([&](Plane2 step, Plane2 place, double weight) {
        step_sum = step_sum + weight * step;
        place_sum = place_sum + weight * place;
        weights += weight;
    });
    SampleMetric metric;
    for_each([&](Plane2 step, Plane2 place, double weight) {
        const double root = std::sqrt(weight), share = 1 / weights;
        metric.add(root * (step + -share * step_sum), root * (place + -share * place_sum));
    });
    return metric.solve().value_or(cell.metric);
}

/// Gives a cell the frame of the photon nearest to its middle, and its metric; none where its photons and those around
/// it span nothing.
inline void choose_frame(SheetCell& cell, const SheetCells& cells, const PathSamples& photons) {
    const EmissionCells& grid = cells.grid();
    const auto inside = grid.photons(cell.square);
    const auto middle = grid.middle(cell.square);
    double nearest = std::numeric_limits<double>::infinity();
    for (const std::uint32_t i : inside) {
        if (!photons[i].frame.is_regular())
            continue;
        const Plane2 away = grid.step_between(middle, photons[i].sample.at);
        const Plane2 in_cells{away.x * double(grid.columns()), away.y * double(grid.rows())};
        if (inner(in_cells, in_cells) < nearest) {
            nearest = inner(in_cells, in_cells);
            cell.frame = photons[i].frame;
            cell.frame_sample = photons[i].sample.at;
            const auto& tangents = photons[i].tangents;
            cell.size2 = inner(tangents[0], tangents[0]) + inner(tangents[1], tangents[1]);
        }
    }
    SampleMetric metric;
    const auto add = [&](std::size_t square) {
        for (const std::uint32_t i : grid.photons(square))
            metric.add(grid.step_between(cell.frame_sample, photons[i].sample.at), cell.frame.to(photons[i].frame));
    };
    add(cell.square);
    auto solved = metric.solve();
    if (!solved) { // a border leaves few photons to a cell, or all of them in a line
        cells.for_each_around(cell, [&](const SheetCell& other, double) {
            if (&other != &cell)
                add(other.square);
        });
        solved = metric.solve();
    }
    if (solved && std::isfinite(nearest)) {
        cell.metric = *solved;
        cell.metric_by_side = {metric_on_side(cell, cells, photons, 0), metric_on_side(cell, cells, photons, 1)};
        cell.has_frame = true;
    }
}

} // namespace nephroid::detail
