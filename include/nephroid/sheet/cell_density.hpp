// SPDX-License-Identifier: MIT
/// @file  The mean density of light in a cell, and the mean irradiance on its patch.
#pragma once

#include "nephroid/sheet/lit_patch.hpp"
#include "nephroid/sheet/node_lattice.hpp"
#include "nephroid/sheet/refinement.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace nephroid::detail {

/// The mean over a cell of the quadratic through the nine nodes of its block of 2 × 2 cells [Newton and Cotes: weights
/// (5, 8, −1)/12 along each axis]; the mean of the cell's corners if the block is not whole.
///
/// @param ends   of the cell's corners on the sheet, counter-clockwise
/// @param known  known(place) -> NodeEnds: nodes that have been traced
template <Vector3 V, Flux F, class Known>
[[nodiscard]] F mean_density(const Cell& cell, const std::array<const NodeEnd<V, F>*, 4>& ends, const Known& known) {
    using T = scalar_t<V>;
    const auto mean_of_corners = [&ends] {
        return static_cast<F>((ends[0]->density + ends[1]->density + (ends[2]->density + ends[3]->density)) * T(0.25));
    };
    const std::int64_t step = cell.step;
    const LatticePlace block{cell.place.i & ~(2 * step - 1), cell.place.j & ~(2 * step - 1)};
    constexpr std::array<double, 3> weight = {5.0 / 12, 8.0 / 12, -1.0 / 12};
    F sum = flux_traits<F>::zero();
    for (std::int64_t j = 0; j < 3; ++j)
        for (std::int64_t i = 0; i < 3; ++i) {
            const NodeEnd<V, F>* const node =
                end_of<V, F>(known(LatticePlace{block.i + i * step, block.j + j * step}), ends[0]->signature);
            if (!node)
                return mean_of_corners();
            const double along_u = weight[std::size_t(cell.place.i == block.i ? i : 2 - i)],
                         along_v = weight[std::size_t(cell.place.j == block.j ? j : 2 - j)];
            sum = sum + node->density * T(along_u * along_v);
        }
    // Where the density falls to zero the quadratic may fall below.
    return flux_traits<F>::power(sum) > 0 ? sum : mean_of_corners();
}

/// The mean irradiance on a patch, from its corners.
template <Vector3 V, Flux F>
[[nodiscard]] double mean_irradiance(const LitPatch<V, F>& patch) {
    const auto& c = patch.corners;
    const double area =
        0.5 * length(plain_cross(c[1][1].position - c[0][0].position, c[0][1].position - c[1][0].position));
    return area > 0 ? flux_traits<F>::power(patch.flux) / area : std::numeric_limits<double>::infinity();
}

} // namespace nephroid::detail
