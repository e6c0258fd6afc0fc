// SPDX-License-Identifier: MIT
/// @file  Where more photons are needed: blocks of 2 × 2 cells are split until their patches say where light lands.
#pragma once

#include "nephroid/sheet/block_need.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace nephroid::detail {

/// Splits the blocks of one tile, the coarse ones first and among those the ones in most need.
///
/// @tparam Nodes  NodeCache
template <Vector3 V, Flux F, class Nodes>
class BlockRefiner {
public:
    /// @param tile        of whose blocks the finer nodes are known
    /// @param most_nodes  that may be added to the regular ones
    BlockRefiner(const BlockNeeds<V, F>& needs, Nodes& nodes, const LatticeRange& tile, std::size_t most_nodes)
        : needs_(needs), nodes_(nodes), tile_(tile), most_nodes_(most_nodes) {}

    /// Appends the cells of blocks, or of what they are split into.
    ///
    /// @param blocks  of one size
    void refine(std::vector<Cell> blocks, std::vector<Cell>& cells) {
        std::vector<BlockNeed> needs;
        while (!blocks.empty()) {
            look_at(blocks, needs);
            blocks = split(blocks, needs, cells);
        }
    }

    /// Splits blocks none of whose nodes met anything, but into which a sheet reaches from beside them, between their
    /// nodes. To be called when all blocks have been refined.
    void refine_empty(std::vector<Cell>& cells) {
        for (bool is_done = false; !is_done;) {
            is_done = true;
            std::vector<Cell> waiting;
            waiting.swap(empty_);
            for (const Cell& block : waiting)
                if (!is_reached(block.place, block.step)) {
                    empty_.push_back(block);
                } else {
                    refine(split({block}, {{2, true}}, cells), cells);
                    is_done = false;
                }
        }
    }

    /// Blocks that were not split as the tile had too many nodes.
    [[nodiscard]] std::uint64_t capped() const { return capped_; }

private:
    static constexpr std::int64_t finest = std::int64_t(1) << Lattice::bisections; ///< step of a cell

    /// Takes out the empty ones, and says of the others how much they need to be split.
    void look_at(std::vector<Cell>& blocks, std::vector<BlockNeed>& needs) {
        needs.clear();
        const auto known = [&](const LatticePlace& p) { return nodes_.known(p); };
        const auto is_left = [&](const Cell& cell) {
            // The corners of cells must be there, split or not.
            const auto block =
                block_at<V, F>(cell.place, cell.step, [&](const LatticePlace& p) { return nodes_.at(p); });
            const bool may_split = cell.step > finest;
            if (is_empty<V, F>(block)) {
                if (may_split)
                    empty_.push_back(cell);
                return false;
            }
            needs.push_back(may_split ? needs_(block, cell.place, cell.step, known) : BlockNeed{});
            return true;
        };
        std::size_t left = 0;
        for (const Cell& cell : blocks)
            if (is_left(cell))
                blocks[left++] = cell;
        blocks.resize(left);
    }

    /// @return  the quarters of those that were split
    [[nodiscard]] std::vector<Cell> split(const std::vector<Cell>& blocks, const std::vector<BlockNeed>& needs,
                                          std::vector<Cell>& cells) {
        std::vector<std::size_t> order;
        for (std::size_t i = 0; i < blocks.size(); ++i)
            if (needs[i].is_split())
                order.push_back(i);
        constexpr std::size_t nodes_of_split = 12; // a block by itself takes 16, and shares those on its sides
        const std::size_t most = most_nodes_ > nodes_.added() ? (most_nodes_ - nodes_.added()) / nodes_of_split : 0;
        if (order.size() > most) {
            capped_ += order.size() - most;
            std::stable_sort(order.begin(), order.end(),
                             [&](std::size_t a, std::size_t b) { return needs[a].ratio > needs[b].ratio; });
            order.resize(most);
            std::sort(order.begin(), order.end());
        }
        std::vector<Cell> quarters;
        auto next = order.begin();
        for (std::size_t k = 0; k < blocks.size(); ++k) {
            const bool is_split = next != order.end() && *next == k;
            next += is_split;
            for (std::int64_t j = 0; j < 2; ++j)
                for (std::int64_t i = 0; i < 2; ++i) {
                    const Cell& block = blocks[k];
                    const LatticePlace corner{block.place.i + i * block.step, block.place.j + j * block.step};
                    if (is_split)
                        quarters.push_back({corner, block.step / 2});
                    else
                        cells.push_back({corner, block.step});
                }
        }
        return quarters;
    }

    /// Whether a node that was traced on a block's sides, for a finer neighbour, met something. Where a neighbour may
    /// be another tile's, which is not known here, three nodes on each half of a side are traced.
    [[nodiscard]] bool is_reached(const LatticePlace& place, std::int64_t step) {
        const LatticePlace along[2] = {{1, 0}, {0, 1}};
        for (std::size_t axis = 0; axis < 2; ++axis)
            for (std::int64_t far_side = 0; far_side < 2; ++far_side) {
                const LatticePlace way = along[axis], out = along[1 - axis];
                const LatticePlace begin = place + (2 * step * far_side) * out;
                const LatticePlace beyond = begin + ((far_side == 0 ? -1 : 1) * step) * out;
                bool is_lit_beyond = false, is_known_beyond = true;
                for (std::int64_t k = 0; k <= 2; ++k)
                    is_lit_beyond |= !nodes_.known(beyond + (k * step) * way).empty();
                is_known_beyond = tile_.contains(beyond + step * way);
                if (!is_known_beyond && is_lit_beyond)
                    for (std::int64_t k = 1; k < 8; ++k)
                        if (!nodes_.at(begin + (k * step / 4) * way).empty())
                            return true;
                for (std::int64_t k = finest; is_known_beyond && k < 2 * step; k += finest)
                    if (!nodes_.known(begin + k * way).empty())
                        return true;
            }
        return false;
    }

    const BlockNeeds<V, F>& needs_;
    Nodes& nodes_;
    LatticeRange tile_;
    std::size_t most_nodes_;
    std::vector<Cell> empty_; ///< blocks none of whose nodes met anything
    std::uint64_t capped_ = 0;
};

} // namespace nephroid::detail
