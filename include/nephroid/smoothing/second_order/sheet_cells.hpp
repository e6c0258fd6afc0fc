// SPDX-License-Identifier: MIT
/// @file  A grid of cells over one sheet of a light's domain, those without photons left out.
#pragma once

#include "nephroid/smoothing/second_order/emission_cells.hpp"
#include "nephroid/smoothing/second_order/path_derivatives.hpp"
#include "nephroid/vector/plane.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <utility>
#include <vector>

namespace nephroid::detail {

/// A square of the grid with photons in it, and what they say. Built up in steps: sheet_metric.hpp gives it its frame,
/// sheet_fit.hpp its derivatives, sheet_border.hpp its border, SheetField its shape.
struct SheetCell {
    std::size_t square;
    EmissionFrame frame{}; ///< of the photon nearest to the middle
    std::array<double, 2> frame_sample{};
    double size2 = 0;     ///< of that photon's tangents
    PlaneMatrix metric{}; ///< steps between samples to displacements in the frame
    std::array<PlaneMatrix, 2> metric_by_side{};
    PathDerivatives map{}; ///< at the middle
    Symmetric2 log_q{}, shape{};
    bool has_frame = false, is_resolved = false;
    bool is_next_to_border = false;                                   ///< which lies within it
    double border_distance = std::numeric_limits<double>::infinity(); ///< of the middle, in the frame's units; less
                                                                      ///< than 0 beyond the border
    Plane2 border_direction{};                                        ///< unit, or 0 where the border is all around
};

/// A corner of the square of cell middles about a sample.
struct SheetNode {
    std::size_t square;
    double weight;               ///< bilinear
    std::array<double, 2> slope; ///< of the weight, by the samples
};

/// How many photons a cell is to have. Those that keep apart determine derivatives by fewer, so that cells may be
/// smaller; where chance takes some of them out, they keep apart no more.
///
/// @param share  of the light's photons that chance sent on this sheet's path, 1 for all
[[nodiscard]] inline double photons_per_cell(bool stratified, double share) {
    return stratified && share == 1 ? 9 : EmissionCells::photons_per_cell;
}

/// The cells of a sheet, found by their squares and as neighbours of one another.
class SheetCells {
public:
    static constexpr std::uint32_t nowhere = (std::numeric_limits<std::uint32_t>::max)();

    /// @param grid  of the sheet's photons
    explicit SheetCells(EmissionCells grid) : grid_(std::move(grid)), slots_(grid_.size(), nowhere) {
        for (std::size_t square = 0; square < grid_.size(); ++square)
            if (!grid_.photons(square).empty()) {
                slots_[square] = std::uint32_t(cells_.size());
                cells_.push_back({.square = square});
            }
    }

    [[nodiscard]] const EmissionCells& grid() const { return grid_; }
    [[nodiscard]] std::size_t size() const { return cells_.size(); }
    [[nodiscard]] SheetCell& operator[](std::size_t index) { return cells_[index]; }
    [[nodiscard]] const SheetCell& operator[](std::size_t index) const { return cells_[index]; }
    [[nodiscard]] std::uint32_t index_of(const SheetCell& cell) const { return slots_[cell.square]; }
    /// Nothing where a square has no photons.
    [[nodiscard]] const SheetCell* cell_in(std::size_t square) const {
        return slots_[square] == nowhere ? nullptr : &cells_[slots_[square]];
    }

    /// Calls visit(cell, weight) for a cell and those of the eight around it that have photons; weights are those of a
    /// (1 2 1)² blur.
    template <class Visit>
    void for_each_around(const SheetCell& cell, Visit&& visit) const {
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx)
                if (const auto square = grid_.neighbour(cell.square, dx, dy))
                    if (const SheetCell* other = cell_in(*square))
                        visit(*other, double((2 - std::abs(dx)) * (2 - std::abs(dy))));
    }

    /// The four whose values are blended where a sample is.
    [[nodiscard]] std::array<SheetNode, 4> nodes_about(const std::array<double, 2>& sample) const {
        struct Axis {
            std::array<std::size_t, 2> at;
            double share;
        };
        const auto along = [this](double u, std::size_t count) {
            const double place = u * double(count) - 0.5, low = std::floor(place);
            const auto bring_back = [&](double i) {
                if (grid_.repeats())
                    return std::size_t(i < 0 ? i + double(count) : i >= double(count) ? i - double(count) : i);
                return std::size_t(std::clamp(i, 0.0, double(count) - 1));
            };
            return Axis{{bring_back(low), bring_back(low + 1)}, place - low};
        };
        const Axis x = along(sample[0], grid_.columns()), y = along(sample[1], grid_.rows());
        std::array<SheetNode, 4> nodes;
        for (std::size_t i = 0; i < 4; ++i) {
            const bool right = i & 1, up = i & 2;
            const double wx = right ? x.share : 1 - x.share, wy = up ? y.share : 1 - y.share;
            nodes[i] = {y.at[up] * grid_.columns() + x.at[right],
                        wx * wy,
                        {(right ? wy : -wy) * double(grid_.columns()), (up ? wx : -wx) * double(grid_.rows())}};
        }
        return nodes;
    }

private:
    EmissionCells grid_;
    std::vector<std::uint32_t> slots_; // of each square: its cell, or nowhere
    std::vector<SheetCell> cells_;
};

} // namespace nephroid::detail
