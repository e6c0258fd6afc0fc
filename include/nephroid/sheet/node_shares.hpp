// SPDX-License-Identifier: MIT
/// @file  How the photons that refine a chart are shared among its tiles.
#pragma once

#include "nephroid/sheet/block_need.hpp"
#include "nephroid/sheet/sheet_grid.hpp"

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace nephroid::detail {

/// How many nodes may be added to each tile, in proportion to what its regular blocks need.
///
/// @param nodes  that may be added in all
template <Vector3 V, Flux F, class E>
[[nodiscard]] std::vector<double> nodes_of_tiles(const BlockNeeds<V, F>& needs, const NodeGrid<V, F>& grid,
                                                 const Lattice& lattice, std::span<const CellRange> tiles, double nodes,
                                                 E& executor) {
    std::vector<double> wanted(tiles.size());
    if (lattice.levels == 0)
        return wanted;
    const auto known = [&grid](const LatticePlace& p) { return grid.has(p) ? grid[p] : NodeEnds<V, F>{}; };
    executor(tiles.size(), [&](std::size_t i) {
        const std::int64_t step = lattice.step();
        wanted[i] = 12; // for what lies between the regular nodes
        for (std::int64_t v = tiles[i].begin_v; v < tiles[i].end_v; v += 2)
            for (std::int64_t u = tiles[i].begin_u; u < tiles[i].end_u; u += 2) {
                const LatticePlace place{u * step, v * step};
                wanted[i] += needs(block_at<V, F>(place, step, known), place, step, known).photons(lattice.levels);
            }
    });
    const double all = std::accumulate(wanted.begin(), wanted.end(), 0.0);
    for (double& one : wanted)
        one *= nodes / all;
    return wanted;
}

} // namespace nephroid::detail
