// SPDX-License-Identifier: MIT
/// @file  Maps the directions above a floor to the unit square, and divides the square into cells.
#pragma once

#include "common/ray.hpp"

#include "nephroid/emission/warp.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace nephroid::examples {

/// The direction above the horizon, unit, that a point of the unit square stands for. Points uniform in the square have
/// the density cos/π per steradian: the irradiance is π times the mean radiance over the square.
[[nodiscard]] inline Vec3<double> direction_above(double u, double v) {
    const DiskPoint<double> disk = concentric_disk(u, v);
    const double height2 = 1 - (disk.x * disk.x + disk.y * disk.y);
    return {disk.x, disk.y, std::sqrt((std::max)(0.0, height2))};
}

/// The unit square in 2^level × 2^level cells, numbered row by row.
class DirectionGrid {
public:
    /// @param level  0 to 15
    explicit DirectionGrid(unsigned level) : level_(level) {}

    [[nodiscard]] unsigned level() const { return level_; }
    [[nodiscard]] std::uint32_t side() const { return 1u << level_; }
    [[nodiscard]] std::uint32_t cells() const { return 1u << (2 * level_); }

    /// @param u,v  in [0, 1)
    [[nodiscard]] std::uint32_t cell_at(double u, double v) const {
        const auto along = [this](double w) { return (std::min)(static_cast<std::uint32_t>(w * side()), side() - 1); };
        return along(v) << level_ | along(u);
    }

    /// The cell of a coarser grid that a cell lies in.
    [[nodiscard]] std::uint32_t cell_in(const DirectionGrid& coarser, std::uint32_t cell) const {
        const unsigned levels = level_ - coarser.level_;
        return (cell >> level_) >> levels << coarser.level_ | (cell & (side() - 1)) >> levels;
    }

    /// The point of a cell at (u, v) within it, both in [0, 1).
    [[nodiscard]] std::array<double, 2> point_in(std::uint32_t cell, double u, double v) const {
        return {((cell & (side() - 1)) + u) / side(), ((cell >> level_) + v) / side()};
    }

    /// Calls visit(cell) for a cell and its neighbours, up to eight.
    template <class Visit>
    void for_neighbourhood(std::uint32_t cell, Visit&& visit) const {
        const std::uint32_t x = cell & (side() - 1), y = cell >> level_, last = side() - 1;
        for (std::uint32_t j = y - (y > 0); j <= y + (y < last); ++j)
            for (std::uint32_t i = x - (x > 0); i <= x + (x < last); ++i)
                visit(j << level_ | i);
    }

    /// Calls visit(cell) for a cell's four parts in the grid of the next level.
    template <class Visit>
    void for_children(std::uint32_t cell, Visit&& visit) const {
        const std::uint32_t x = 2 * (cell & (side() - 1)), y = 2 * (cell >> level_);
        for (const std::uint32_t j : {y, y + 1})
            for (const std::uint32_t i : {x, x + 1})
                visit(j << (level_ + 1) | i);
    }

private:
    unsigned level_;
};

using Cells = std::vector<std::uint32_t>;

inline void sort_unique(Cells& cells) {
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
}

/// The cells and all their neighbours, sorted.
[[nodiscard]] inline Cells grown(const DirectionGrid& grid, const Cells& cells) {
    Cells more;
    more.reserve(4 * cells.size());
    for (const std::uint32_t cell : cells)
        grid.for_neighbourhood(cell, [&](std::uint32_t neighbour) { more.push_back(neighbour); });
    sort_unique(more);
    return more;
}

/// The parts of the cells in the next level's grid, sorted.
[[nodiscard]] inline Cells divided(const DirectionGrid& grid, const Cells& cells) {
    Cells parts;
    parts.reserve(4 * cells.size());
    for (const std::uint32_t cell : cells)
        grid.for_children(cell, [&](std::uint32_t part) { parts.push_back(part); });
    std::sort(parts.begin(), parts.end());
    return parts;
}

} // namespace nephroid::examples
