// SPDX-License-Identifier: MIT
/// @file  Gives each cell of a path group a frame, and the matrix that takes steps in the domain to the frame.
#pragma once

#include "nephroid/smoothing/second_order/group_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace nephroid::detail {

/// Which pair of opposite triangles a sample lies in, if the diagonals divide the square into four. The concentric map
/// of the square onto a disk has a kink along the diagonals.
[[nodiscard]] inline std::size_t side_of(const std::array<double, 2>& sample) {
    return std::abs(sample[0] - 0.5) > std::abs(sample[1] - 0.5) ? 0 : 1;
}

/// `to_frame`, fitted to those photons in and around a cell that lie on one side of a diagonal. If no diagonal crosses
/// the cell, it is the cell's own.
[[nodiscard]] inline PlaneMatrix to_frame_on_side(const GroupCell& cell, const GroupCells& cells,
                                                  const PathSamples& photons, std::size_t side) {
    const EmissionCells& grid = cells.grid();
    const auto is_here = [&](std::uint32_t i) { return side_of(photons[i].sample.at) == side; };
    const auto inside = grid.photons(cell.square);
    if (std::all_of(inside.begin(), inside.end(), is_here) || std::none_of(inside.begin(), inside.end(), is_here))
        return cell.to_frame;
    Plane2 step_sum{}, displacement_sum{};
    double weights = 0;
    const auto for_each = [&](const auto& visit) {
        cells.for_each_around(cell, [&](const GroupCell& other, double weight) {
            for (const std::uint32_t i : grid.photons(other.square))
                if (is_here(i))
                    visit(grid.step_between(cell.frame_sample, photons[i].sample.at),
                          cell.frame.displacement_to(photons[i].frame), weight);
        });
    };
    for_each([&](Plane2 step, Plane2 displacement, double weight) {
        step_sum = step_sum + weight * step;
        displacement_sum = displacement_sum + weight * displacement;
        weights += weight;
    });
    StepFit fit;
    for_each([&](Plane2 step, Plane2 displacement, double weight) {
        const double root = std::sqrt(weight), norm = 1 / weights; // differences from the weighted means
        fit.add(root * (step + -norm * step_sum), root * (displacement + -norm * displacement_sum));
    });
    return fit.solve().value_or(cell.to_frame);
}

/// Gives a cell the frame of the photon nearest to its middle, and its `to_frame`. It gets neither if the photons in
/// and around it all lie on a line.
inline void choose_frame(GroupCell& cell, const GroupCells& cells, const PathSamples& photons) {
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
    StepFit fit;
    const auto add = [&](std::size_t square) {
        for (const std::uint32_t i : grid.photons(square))
            fit.add(grid.step_between(cell.frame_sample, photons[i].sample.at),
                    cell.frame.displacement_to(photons[i].frame));
    };
    add(cell.square);
    auto solved = fit.solve();
    if (!solved) { // beside a border a cell may have few photons, or all of them on a line
        cells.for_each_around(cell, [&](const GroupCell& other, double) {
            if (&other != &cell)
                add(other.square);
        });
        solved = fit.solve();
    }
    if (solved && std::isfinite(nearest)) {
        cell.to_frame = *solved;
        cell.to_frame_by_side = {to_frame_on_side(cell, cells, photons, 0), to_frame_on_side(cell, cells, photons, 1)};
        cell.has_frame = true;
    }
}

} // namespace nephroid::detail
