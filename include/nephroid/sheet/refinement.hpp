// SPDX-License-Identifier: MIT
/// @file  When cells of a chart are split, and how carefully dim light is drawn.
#pragma once

#include "nephroid/sheet/node_lattice.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace nephroid {

/// When blocks of cells are split. Those whose light no vertex sees never are.
struct Refinement {
    unsigned levels = 6;     ///< times that a cell may be split into four, 0 to 10; 0: a regular grid
    double tolerance = 0.06; ///< largest error in place of a patch between its corners, in pixels; > 0
    double relative = 0.01;  ///< the same over the patch's longest side, > 0, as errors in place are errors in density.
                             ///< The stricter of the two holds, but this one never asks for less than 0.02 pixels
};

namespace detail {

/// A cell of a chart: a square that is drawn. Also a block of 2 × 2 cells, by its first cell.
struct Cell {
    LatticePlace place; ///< of its first corner
    std::int64_t step;  ///< of its sides
};

/// A rectangle of a chart, borders included, in steps of the lattice.
struct LatticeRange {
    LatticePlace low, high;

    [[nodiscard]] bool contains(const LatticePlace& p) const {
        return p.i >= low.i && p.j >= low.j && p.i <= high.i && p.j <= high.j;
    }
};

/// How bright the picture is, which tells how much larger the errors of dim light may be.
struct Brightness {
    double mean = 0; ///< irradiance of the whole picture, about; 0: not known

    /// How many times larger the errors of a patch may be: sqrt(mean / (10 irradiance)), clamped to [1, 8].
    [[nodiscard]] double allowance(double irradiance) const {
        if (!(mean > 10 * irradiance))
            return 1;
        return (std::min)(std::sqrt(mean / (10 * irradiance)), 8.0); // of 0: 8
    }
};

/// How much a block needs to be split.
struct BlockNeed {
    float ratio = 0;        ///< its error over the allowed one; above 1 it should be split
    bool is_broken = false; ///< whether a sheet ends in it

    [[nodiscard]] bool is_split() const { return ratio > 1; }

    /// About how many photons its splitting takes. On a smooth sheet each level reduces errors to an eighth. Where a
    /// sheet ends, each level halves them, and has twice as many blocks along the line.
    [[nodiscard]] double photons(unsigned levels) const {
        if (!is_split())
            return 0;
        const double wanted = std::ceil(std::log2(double(ratio)) / (is_broken ? 1 : 3));
        const double level = (std::min)(wanted, double(levels));
        return is_broken ? 12 * (std::exp2(level) - 1) : 4 * (std::exp2(2 * level) - 1);
    }
};

} // namespace detail
} // namespace nephroid
