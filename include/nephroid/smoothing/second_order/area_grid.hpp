// SPDX-License-Identifier: MIT
/// @file  What a cell of an area light's domain holds, and which cells may be interpolated.
#pragma once

#include "nephroid/smoothing/second_order/area_border.hpp"
#include "nephroid/smoothing/second_order/area_cells.hpp"
#include "nephroid/smoothing/second_order/emission_frame.hpp"
#include "nephroid/smoothing/second_order/path_derivatives.hpp"
#include "nephroid/vector/plane.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace nephroid::detail {

/// A cell, filled in steps: area_cell_fit.hpp sets its frame and derivatives, area_border_search.hpp its border,
/// AreaField its shape.
struct AreaCell {
    EmissionFrame frame;   ///< of the photon nearest to the middle, among those on the commonest path
    PathDerivatives map{}; ///< at the middle; derivatives along the frame's tangents
    std::array<Plane2, 4> samples_by_step{};
    Symmetric2 log_q{}, shape{};
    std::uint32_t signature = 0; ///< of the commonest path
    bool has_frame = false;
    bool is_resolved = false; ///< whether the photons determined the derivatives
    std::optional<AreaBorder> border{};
    double border_distance = std::numeric_limits<double>::infinity(); ///< along the tangents, in their units
    Plane2 border_direction{};
};

/// A grid and the contents of its cells.
struct AreaGrid {
    AreaCells grid;
    std::vector<AreaCell> cells;

    explicit AreaGrid(AreaCells of_photons) : grid(std::move(of_photons)), cells(grid.size()) {}

    /// Whether two cells describe the same path, so that values may be interpolated between them.
    [[nodiscard]] bool are_linked(std::size_t a, std::size_t b) const {
        return a == b || (cells[a].is_resolved && cells[b].is_resolved && cells[a].signature == cells[b].signature);
    }
};

} // namespace nephroid::detail
