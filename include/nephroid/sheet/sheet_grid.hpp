// SPDX-License-Identifier: MIT
/// @file  How many cells each chart gets, and the order in which they are drawn: by sectors, and in these by tiles.
#pragma once

#include "nephroid/emission/chart/emission_chart.hpp"
#include "nephroid/pass/photon_pass.hpp"
#include "nephroid/sheet/node_lattice.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace nephroid::detail {

/// Divides a chart into cells: about square, even in number along each side, with this many nodes at most.
///
/// @param stretch  cells are wider than they would be by this factor, and less high
template <Vector3 V, Flux F>
[[nodiscard]] Lattice lattice_of(const EmissionChart<V, F>& chart, double nodes, double stretch, unsigned levels) {
    const auto even = [](double cells) {
        return (std::max)(std::int64_t(2), std::int64_t(std::floor(0.5 * cells + 1e-9)) * 2);
    };
    const double side = std::sqrt((std::max)(nodes, 1.0)), shape = stretch * std::sqrt(chart.width / chart.height);
    const std::int64_t columns = even(side * shape - 1);
    return {columns, even(nodes / double(columns + 1) - 1), levels};
}

/// Shares photons among charts by power. Passes that follow each other (`first` a multiple of `count`) have cells up to
/// a tenth wider or higher, so that their nodes lie elsewhere and what they miss averages out.
///
/// @param nodes  of all charts
template <Vector3 V, Flux F>
[[nodiscard]] std::vector<Lattice> lattices_of(const EmissionCharts<V, F>& charts, const PhotonPass& pass, double nodes,
                                               unsigned levels) {
    double power = 0;
    for (const auto& chart : charts)
        power += chart.power;
    const double turn = 0.5 + 0.6180339887498949 * double(pass.first / pass.count);
    const double stretch = 1 + 0.2 * (turn - std::floor(turn) - 0.5); // 1 for the first pass
    std::vector<Lattice> lattices;
    for (const auto& chart : charts)
        lattices.push_back(lattice_of(chart, power > 0 ? nodes * chart.power / power : 0, stretch, levels));
    return lattices;
}

/// Divides a chart's cells into squares. Only the nodes of one of them are in memory at a time.
[[nodiscard]] inline std::vector<CellRange> sectors_of(const Lattice& lattice) {
    constexpr std::int64_t side = 512;
    std::vector<CellRange> sectors;
    for (std::int64_t v = 0; v < lattice.cells_v; v += side)
        for (std::int64_t u = 0; u < lattice.cells_u; u += side)
            sectors.push_back({u, (std::min)(u + side, lattice.cells_u), v, (std::min)(v + side, lattice.cells_v)});
    return sectors;
}

inline constexpr std::int64_t tile_side = 16; ///< cells of a tile

[[nodiscard]] inline std::int64_t tile_count(const Lattice& lattice) {
    const auto across = [](std::int64_t cells) { return (cells + tile_side - 1) / tile_side; };
    return across(lattice.cells_u) * across(lattice.cells_v);
}

/// Divides a sector into tiles, in the order of a Z-shaped curve [Morton 1966].
[[nodiscard]] inline std::vector<CellRange> tiles_of(const CellRange& sector) {
    constexpr std::int64_t side = tile_side;
    const auto spread = [](std::uint32_t x) {
        x = (x | x << 4) & 0x0f0f0f0fu;
        x = (x | x << 2) & 0x33333333u;
        return (x | x << 1) & 0x55555555u;
    };
    std::vector<std::pair<std::uint32_t, CellRange>> tiles;
    for (std::int64_t v = sector.begin_v; v < sector.end_v; v += side)
        for (std::int64_t u = sector.begin_u; u < sector.end_u; u += side) {
            const auto i = std::uint32_t((u - sector.begin_u) / side), j = std::uint32_t((v - sector.begin_v) / side);
            tiles.push_back({spread(i) | spread(j) << 1,
                             {u, (std::min)(u + side, sector.end_u), v, (std::min)(v + side, sector.end_v)}});
        }
    std::sort(tiles.begin(), tiles.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<CellRange> in_order;
    for (const auto& tile : tiles)
        in_order.push_back(tile.second);
    return in_order;
}

} // namespace nephroid::detail
