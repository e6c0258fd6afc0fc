// SPDX-License-Identifier: MIT
/// @file  A grid of cells over the photons of one path group; squares without photons have no cell.
#pragma once

#include "nephroid/smoothing/second_order/emission_cells.hpp"
#include "nephroid/smoothing/second_order/map_kinks.hpp"
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

/// A square of the grid with photons in it. It is filled in steps: group_frames.hpp sets its frame, group_fit.hpp its
/// derivatives, group_borders.hpp its border, and GroupField its shape.
struct GroupCell {
    std::size_t square;
    EmissionFrame frame{}; ///< of the photon nearest to the middle
    std::array<double, 2> frame_sample{};
    double size2 = 0;       ///< squared length of that photon's tangents
    PlaneMatrix to_frame{}; ///< takes steps between emission coordinates to displacements in the frame
    std::array<PlaneMatrix, 2> to_frame_by_side{};
    PathDerivatives map{}; ///< at the middle
    MapKinks kinks{};      ///< in the cell, later also around it (GroupField)
    double scatter = 0;    ///< of the photons' tangents about the map (tangent_scatter)
    Symmetric2 log_q{}, shape{};
    bool has_frame = false;
    bool is_resolved = false;     ///< whether the photons determined the derivatives
    bool is_contradicted = false; ///< whether photons landed elsewhere than the derivatives say
    bool has_border = false;      ///< whether a border lies within the cell
    double border_distance = std::numeric_limits<double>::infinity(); ///< from the middle, in the frame's units;
                                                                      ///< negative beyond the border
    Plane2 border_direction{};                                        ///< unit, or 0 where the border is all around
    double across_distance = std::numeric_limits<double>::infinity(); ///< to a second border, across the first
    Plane2 across_direction{};                                        ///< towards it, unit; 0 if there is none
};

/// One of the four squares whose middles surround a sample.
struct InterpolationNode {
    std::size_t square;
    double weight;               ///< bilinear
    std::array<double, 2> slope; ///< of the weight, by the emission coordinates
};

/// How many photons a cell should have. Stratified photons keep apart, so that fewer of them determine derivatives and
/// cells may be smaller. They no longer keep apart where chance sends some of them on another path.
///
/// @param share  of the photons that took this group's path; 1 for all
[[nodiscard]] inline double photons_per_cell(bool stratified, double share) {
    return stratified && share == 1 ? 9 : EmissionCells::photons_per_cell;
}

/// The cells of a group.
class GroupCells {
public:
    static constexpr std::uint32_t no_cell = (std::numeric_limits<std::uint32_t>::max)();

    /// @param grid  over the group's photons
    explicit GroupCells(EmissionCells grid) : grid_(std::move(grid)), slots_(grid_.size(), no_cell) {
        for (std::size_t square = 0; square < grid_.size(); ++square)
            if (!grid_.photons(square).empty()) {
                slots_[square] = std::uint32_t(cells_.size());
                cells_.push_back({.square = square});
            }
    }

    [[nodiscard]] const EmissionCells& grid() const { return grid_; }
    [[nodiscard]] std::size_t size() const { return cells_.size(); }
    [[nodiscard]] GroupCell& operator[](std::size_t index) { return cells_[index]; }
    [[nodiscard]] const GroupCell& operator[](std::size_t index) const { return cells_[index]; }
    [[nodiscard]] std::uint32_t index_of(const GroupCell& cell) const { return slots_[cell.square]; }
    /// The cell in a square; null if the square has no photons.
    [[nodiscard]] const GroupCell* cell_in(std::size_t square) const {
        return slots_[square] == no_cell ? nullptr : &cells_[slots_[square]];
    }

    /// Calls visit(cell, weight) for a cell and for those of the eight around it that have photons. The weights are
    /// those of a (1 2 1)² blur.
    template <class Visit>
    void for_each_around(const GroupCell& cell, Visit&& visit) const {
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx)
                if (const auto square = grid_.neighbour(cell.square, dx, dy))
                    if (const GroupCell* other = cell_in(*square))
                        visit(*other, double((2 - std::abs(dx)) * (2 - std::abs(dy))));
    }

    /// The four squares between whose middles values are interpolated at a sample.
    [[nodiscard]] std::array<InterpolationNode, 4> nodes_around(const std::array<double, 2>& sample) const {
        struct Axis {
            std::array<std::size_t, 2> at;
            double fraction;
        };
        const auto along = [this](double u, std::size_t count) {
            const double position = u * double(count) - 0.5, low = std::floor(position);
            const auto into_range = [&](double i) {
                if (grid_.repeats())
                    return std::size_t(i < 0 ? i + double(count) : i >= double(count) ? i - double(count) : i);
                return std::size_t(std::clamp(i, 0.0, double(count) - 1));
            };
            return Axis{{into_range(low), into_range(low + 1)}, position - low};
        };
        const Axis x = along(sample[0], grid_.columns()), y = along(sample[1], grid_.rows());
        std::array<InterpolationNode, 4> nodes;
        for (std::size_t i = 0; i < 4; ++i) {
            const bool right = i & 1, up = i & 2;
            const double wx = right ? x.fraction : 1 - x.fraction, wy = up ? y.fraction : 1 - y.fraction;
            nodes[i] = {y.at[up] * grid_.columns() + x.at[right],
                        wx * wy,
                        {(right ? wy : -wy) * double(grid_.columns()), (up ? wx : -wx) * double(grid_.rows())}};
        }
        return nodes;
    }

private:
    EmissionCells grid_;
    std::vector<std::uint32_t> slots_; // for each square the index of its cell, or no_cell
    std::vector<GroupCell> cells_;
};

} // namespace nephroid::detail
