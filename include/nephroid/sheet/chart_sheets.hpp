// SPDX-License-Identifier: MIT
/// @file  Draws the sheets of one chart: traces the nodes of one sector after the other, makes pieces of the cells of
///        each tile, and adds the pieces to the sums of each leaf.
#pragma once

#include "nephroid/emission/chart/chart_light.hpp"
#include "nephroid/receiver/sums.hpp"
#include "nephroid/sheet/cell_pieces.hpp"
#include "nephroid/sheet/leaf_bins.hpp"
#include "nephroid/sheet/node_shares.hpp"
#include "nephroid/sheet/node_tracer.hpp"
#include "nephroid/sheet/refine.hpp"
#include "nephroid/sheet/sheet_grid.hpp"
#include "nephroid/sheet/sheet_options.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace nephroid {

namespace detail {

/// Draws the sheets of one chart.
template <class S, Vector3 V, Flux F, class R, class E, class TakeOver>
class ChartSheets {
public:
    using T = scalar_t<V>;
    using Node = NodeEnd<V, F>;

    ChartSheets(const S& scene, const EmissionChart<V, F>& chart, Sums<V, F, R>& sums, const ReceiverPixels<V>& pixels,
                const SheetOptions& options, const WalkLimits& limits, const Brightness& brightness, double weight,
                E& executor, TakeOver& take_over)
        : scene_(scene), chart_(chart), sums_(sums), pixels_(pixels), options_(options), limits_(limits),
          brightness_(brightness), weight_(weight), executor_(executor), take_over_(take_over),
          bins_(sums.map().tree().leaves().size()) {}

    /// @param refining  how many nodes may be added to the regular ones of the lattice
    void draw(const Lattice& lattice, double refining, SheetStatistics& statistics) {
        for (const CellRange& sector : sectors_of(lattice)) {
            announce(executor_, Phase::trace);
            trace(lattice, sector, statistics);
            const std::vector<CellRange> tiles = tiles_of(sector);
            const double nodes = refining * double(sector.cells()) / double(lattice.cells_u * lattice.cells_v);
            const std::vector<double> most_nodes =
                nodes_of_tiles(BlockNeeds<V, F>(pixels_, options_.refinement, lattice.area()), grid_, lattice, tiles,
                               nodes, executor_);
            for (std::size_t first = 0; first < tiles.size(); first += tiles_per_batch) {
                const auto batch = std::span(tiles).subspan(first, (std::min)(tiles_per_batch, tiles.size() - first));
                announce(executor_, Phase::fit);
                make_pieces(lattice, batch, std::span(most_nodes).subspan(first, batch.size()), statistics);
                announce(executor_, Phase::splat);
                add_to_sums(batch.size());
            }
        }
    }

private:
    static constexpr std::size_t tiles_per_batch = 32;
    static constexpr bool is_taken_over = !std::is_same_v<TakeOver, DrawBroken>;

    void trace(const Lattice& lattice, const CellRange& sector, SheetStatistics& statistics) {
        traced_.assign(grid_.tasks_of(lattice, sector), {});
        grid_.fill(
            lattice, sector,
            [&](const LatticePlace& place, std::vector<Node>& ends, std::size_t task) {
                trace_node(scene_, chart_, T(lattice.u(place)), T(lattice.v(place)),
                           area_of_node(lattice, sector, place), sums_.map().tree().origin(), limits_, ends,
                           traced_[task]);
            },
            executor_);
        statistics.sheets.nodes += grid_.size();
        is_by_chance_ = false;
        for (const TracedNodes& traced : traced_) {
            is_by_chance_ |= traced.by_chance > 0;
            statistics.light += traced.account;
            statistics.unresolved += traced.landed;
            statistics.sheets.by_chance += traced.by_chance;
        }
    }

    /// Makes the pieces of some tiles, and hands over those that are broken.
    void make_pieces(const Lattice& lattice, std::span<const CellRange> tiles, std::span<const double> most_nodes,
                     SheetStatistics& statistics) {
        const BlockNeeds<V, F> needs(pixels_, options_.refinement, lattice.area());
        tiles_.resize((std::max)(tiles_.size(), tiles.size()));
        is_broken_.assign(tiles.size(), 0);
        std::vector<SheetStatistics> accounts(tiles.size());
        executor_(tiles.size(), [&](std::size_t i) {
            TracedNodes traced;
            const auto trace = [&](const LatticePlace& place, std::vector<Node>& ends) {
                trace_node(scene_, chart_, T(lattice.u(place)), T(lattice.v(place)), 0, sums_.map().tree().origin(),
                           limits_, ends, traced);
            };
            NodeCache<V, F, decltype(trace)> nodes(grid_, lattice, trace);
            tiles_[i].clear();
            CellPieces<V, F, decltype(nodes)> pieces(lattice, pixels_, options_.tessellation, brightness_, nodes,
                                                     tiles_[i], accounts[i].sheets);
            const std::int64_t step = lattice.step();
            BlockRefiner<V, F, decltype(nodes)> refiner(
                needs, nodes,
                {{tiles[i].begin_u * step, tiles[i].begin_v * step}, {tiles[i].end_u * step, tiles[i].end_v * step}},
                std::size_t(most_nodes[i]));
            std::vector<Cell> blocks, cells;
            for (std::int64_t v = tiles[i].begin_v; v < tiles[i].end_v; v += 2)
                for (std::int64_t u = tiles[i].begin_u; u < tiles[i].end_u; u += 2)
                    blocks.push_back({{u * step, v * step}, step});
            refiner.refine(std::move(blocks), cells);
            refiner.refine_empty(cells);
            for (const Cell& cell : cells)
                pieces.add(cell);
            accounts[i].sheets.capped += refiner.capped();
            accounts[i].sheets.nodes += nodes.added();
            accounts[i].sheets.by_chance += traced.by_chance;
            accounts[i].light = traced.account;
            is_broken_[i] = is_broken(accounts[i].sheets) || (is_taken_over && (is_by_chance_ || traced.by_chance > 0));
            if (is_broken_[i])
                book_broken(tiles_[i], accounts[i].sheets);
        });
        for (std::size_t i = 0; i < tiles.size(); ++i) {
            statistics.light += accounts[i].light;
            statistics.sheets += accounts[i].sheets;
            if constexpr (is_taken_over)
                if (is_broken_[i]) {
                    const double cells_u = double(lattice.cells_u), cells_v = double(lattice.cells_v);
                    take_over_(chart_,
                               ChartRectangle{double(tiles[i].begin_u) / cells_u, double(tiles[i].end_u) / cells_u,
                                              double(tiles[i].begin_v) / cells_v, double(tiles[i].end_v) / cells_v});
                }
        }
    }

    /// Whether more than a third of the light is in cells in which sheets end.
    [[nodiscard]] static bool is_broken(const SheetAccount& account) {
        return 3 * account.cut.flux > account.seen.flux + account.unseen.flux;
    }

    /// Books the light of a broken tile, and removes its pieces if a caller takes it over.
    static void book_broken(TilePieces<V, F>& tile, SheetAccount& account) {
        ++account.broken_tiles;
        Tally& to = is_taken_over ? account.handed_over : account.broken;
        to.add(account.seen.flux + account.unseen.flux);
        if constexpr (is_taken_over) {
            tile.clear();
            account.seen = account.unseen = account.cut = {};
        }
    }

    void add_to_sums(std::size_t count) {
        const std::span<const TilePieces<V, F>> tiles(tiles_.data(), count);
        bins_.sort(tiles, executor_);
        const std::size_t groups_per_task = std::clamp<std::size_t>(bins_.groups() / 256, 1, 4);
        for_each_index(executor_, bins_.groups(), groups_per_task, [&](std::size_t group) {
            for (const BinnedBlock& binned : bins_[group]) {
                const SheetPieces<V, F>& pieces = tiles[binned.tile].pieces;
                const SheetBlock<V, F>& block = pieces.blocks[binned.block];
                const F flux = static_cast<F>(block.flux * T(weight_));
                add_to_leaf(pieces, block, pixels_, binned.leaf, [&](std::uint32_t slot, T irradiance) {
                    sums_.add(slot, sums_.responded(slot, flux * irradiance, block.direction));
                });
            }
        });
    }

    const S& scene_;
    const EmissionChart<V, F>& chart_;
    Sums<V, F, R>& sums_;
    const ReceiverPixels<V>& pixels_;
    const SheetOptions& options_;
    const WalkLimits& limits_;
    const Brightness& brightness_;
    double weight_;
    E& executor_;
    TakeOver& take_over_;
    NodeGrid<V, F> grid_;
    std::vector<TracedNodes> traced_;
    std::vector<TilePieces<V, F>> tiles_;
    std::vector<char> is_broken_;
    bool is_by_chance_ = false; ///< whether the scene drew random numbers in the sector
    LeafBins bins_;
};

} // namespace detail

} // namespace nephroid
