// SPDX-License-Identifier: MIT
/// @file  The two directions across a block's sides, along which vertices beside the block are recognised.
#pragma once

#include "nephroid/sheet/block_edges.hpp"
#include "nephroid/sheet/sheet_block.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace nephroid::detail {

/// Sets these directions, and how far the block reaches along them.
template <Vector3 V, Flux F>
void set_sides(SheetBlock<V, F>& block, const QuadGrid& grid, const Double3& normal) {
    using T = scalar_t<V>;
    const auto& c = grid.corner;
    const std::size_t rows = grid.rows, columns = grid.columns;
    const std::array<Double3, 2> sides = {(c[0][columns] - c[0][0]) + (c[rows][columns] - c[rows][0]),
                                          (c[rows][0] - c[0][0]) + (c[rows][columns] - c[0][columns])};
    for (std::size_t k = 0; k < 2; ++k) {
        const Double3 axis = unit_or_zero(plain_cross(normal, sides[k]));
        double low = 0, high = 0;
        for (std::size_t j = 0; j <= rows; ++j)
            for (std::size_t i = 0; i <= columns; ++i) {
                const double x = dot(axis, c[j][i]);
                low = (std::min)(low, x), high = (std::max)(high, x);
            }
        block.across[k] = {T(axis.x), T(axis.y), T(axis.z)};
        block.low[k] = T(low), block.high[k] = T(high);
    }
}

} // namespace nephroid::detail
