// SPDX-License-Identifier: MIT
/// @file  Adds photons where they are needed: blocks of 2 × 2 cells are split until their patches predict well enough
///        where light lands.
#pragma once

#include "nephroid/sheet/block_need.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace nephroid::detail {

/// Splits the blocks of one tile, the coarse ones first, and of equally coarse ones those with the largest errors.
///
/// @tparam Nodes  NodeCache
template <Vector3 V, Flux F, class Nodes>
class BlockRefiner {
public:
    /// @param tile        where the tile lies: finer nodes are known only in it
    /// @param most_nodes  how many nodes may be added to the regular ones
    BlockRefiner(const BlockNeeds<V, F>& needs, Nodes& nodes, const LatticeRange& tile, std::size_t most_nodes)
        : needs_(needs), nodes_(nodes), tile_(tile), most_nodes_(most_nodes) {}

    /// Appends the cells of blocks, or of what they are split into.
    ///
    /// @param blocks  all of one size
    void refine(std::vector<Cell> blocks, std::vector<Cell>& cells) {
        std::vector<BlockNeed> needs;
        while (!blocks.empty()) {
            measure(blocks, needs);
            blocks = split(blocks, needs, cells);
        }
    }

    /// Splits empty blocks, none of whose nodes met anything, if a sheet reaches into them between their nodes. To be
    /// called after all blocks have been refined.
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

    /// How many blocks were not split because the tile had too many nodes.
    [[nodiscard]] std::uint64_t capped() const { return capped_; }

private:
    static constexpr std::int64_t finest = std::int64_t(1) << Lattice::bisections; ///< step of a cell

    /// Moves empty blocks to `empty_`, and measures how much each of the others needs to be split.
    void measure(std::vector<Cell>& blocks, std::vector<BlockNeed>& needs) {
        needs.clear();
        const auto known = [&](const LatticePlace& p) { return nodes_.known(p); };
        const auto stays = [&](const Cell& cell) {
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
            if (stays(cell))
                blocks[left++] = cell;
        blocks.resize(left);
    }

    /// Splits the blocks that need it most, as long as nodes are left; the other blocks' cells are appended to `cells`.
    ///
    /// @return  the quarters of the blocks that were split
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

    /// Whether a sheet reaches into an empty block: whether a node on its sides that was traced for a finer neighbour
    /// met something. If the neighbour is in another tile, whose finer nodes are not known here, and is lit, seven
    /// nodes on the side between them are traced.
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
