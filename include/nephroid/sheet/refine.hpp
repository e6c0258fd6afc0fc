// SPDX-License-Identifier: MIT
/// @file  Where more photons are needed: blocks of 2 × 2 cells are split until their patches say where light lands.
#pragma once

#include "nephroid/sheet/node_block.hpp"
#include "nephroid/sheet/receiver_pixels.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace nephroid {

/// When a block of cells is split. Light that no vertex sees is not.
struct Refinement {
    unsigned levels = 4;     ///< times that a cell may be split into four, 0 to 10; 0: a regular grid
    double tolerance = 0.06; ///< by how much a patch may miss a photon between its corners, in pixels; > 0
    double relative = 0.01;  ///< the same, of the patch's size: density is right where place is; > 0
    double most_nodes = 16;  ///< added to a tile at most, as a multiple of its regular ones; of a coarse grid more, up
                             ///< to 200,000 for a chart
};

namespace detail {

/// A square of a chart to be drawn.
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

/// Splits the blocks of one tile.
///
/// @tparam Nodes  NodeCache
template <Vector3 V, Flux F, class Nodes>
class BlockRefiner {
public:
    using Node = NodeEnd<V, F>;

    /// @param tile        of whose blocks the finer nodes are known
    /// @param most_nodes  that may be added to the regular ones
    BlockRefiner(const ReceiverPixels<V>& pixels, const Refinement& rule, Nodes& nodes, const LatticeRange& tile,
                 std::size_t most_nodes)
        : pixels_(pixels), rule_(rule), nodes_(nodes), tile_(tile), most_nodes_(most_nodes) {}

    /// Appends the cells of a block, or of what it is split into.
    ///
    /// @param place  of its first corner
    /// @param step   of its four cells' sides
    void refine(const LatticePlace& place, std::int64_t step, std::vector<Cell>& cells) {
        const bool may_split = step > std::int64_t(1) << Lattice::bisections;
        const Block block = nodes_of(place, step); // the corners of cells must be there, split or not
        if (is_empty<V, F>(block)) {
            if (may_split)
                empty_.push_back({place, step});
            return;
        }
        split_or_take(place, step, may_split && is_rough(block, place, step), cells);
    }

    /// Splits blocks none of whose nodes met anything, but into which a sheet reaches from beside them, between their
    /// nodes. To be called when all blocks have been refined.
    void refine_empty(std::vector<Cell>& cells) {
        for (bool is_done = false; !is_done;) {
            is_done = true;
            std::vector<Cell> waiting;
            waiting.swap(empty_);
            for (const Cell& block : waiting)
                if (is_reached(block.place, block.step)) {
                    split_or_take(block.place, block.step, true, cells);
                    is_done = false;
                } else {
                    empty_.push_back(block);
                }
        }
    }

    /// Blocks that were not split as the tile had too many nodes.
    [[nodiscard]] std::uint64_t capped() const { return capped_; }

private:
    using Block = NodeBlock<V, F>;

    void split_or_take(const LatticePlace& place, std::int64_t step, bool splits, std::vector<Cell>& cells) {
        const bool is_capped = splits && nodes_.added() >= most_nodes_;
        capped_ += std::uint64_t(is_capped);
        for (std::int64_t j = 0; j < 2; ++j)
            for (std::int64_t i = 0; i < 2; ++i) {
                const LatticePlace corner{place.i + i * step, place.j + j * step};
                if (splits && !is_capped)
                    refine(corner, step / 2, cells);
                else
                    cells.push_back({corner, step});
            }
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
                const std::int64_t least = std::int64_t(1) << Lattice::bisections;
                for (std::int64_t k = least; is_known_beyond && k < 2 * step; k += least)
                    if (!nodes_.known(begin + k * way).empty())
                        return true;
            }
        return false;
    }

    [[nodiscard]] Block nodes_of(const LatticePlace& place, std::int64_t step) {
        Block block;
        for (std::int64_t j = 0; j < 3; ++j)
            for (std::int64_t i = 0; i < 3; ++i)
                block[std::size_t(j)][std::size_t(i)] = nodes_.at({place.i + i * step, place.j + j * step});
        return block;
    }

    [[nodiscard]] bool is_rough(const Block& block, const LatticePlace& place, std::int64_t step) const {
        Double3 middle;
        double size = 0;
        if (!is_seen(block, middle, size))
            return false;
        const double pixel = pixels_.pixel_at(middle);
        for (const auto& row : block)
            for (const NodeEnds<V, F>& ends : row)
                for (const Node& end : ends)
                    if (!is_whole<V, F>(block, end.signature, pixel))
                        return size > 0.25 * pixel || count_lit<V, F>(block) < 5; // what is smaller is right to a pixel
        const auto known = [&](const LatticePlace& p) { return nodes_.known(p); };
        for (const Node& end : block[0][0]) {
            const Miss miss = largest_miss<V, F>(block, place, step, known, end.signature, pixel);
            const double allowed =
                (std::min)(rule_.tolerance * pixel, (std::max)(rule_.relative * miss.size, 0.02 * pixel));
            if (!(miss.furthest / 8 <= allowed)) // the miss of the four cells' patches is an eighth of the block's
                return true;
        }
        return false;
    }

    /// Whether the box of a block's ends, grown by half, reaches the receiver.
    [[nodiscard]] bool is_seen(const Block& block, Double3& middle, double& size) const {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        std::array<double, 3> low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
        for (const auto& row : block)
            for (const NodeEnds<V, F>& ends : row)
                for (const Node& end : ends) {
                    const Double3 p = double3(end.position);
                    const std::array<double, 3> c{p.x, p.y, p.z};
                    for (std::size_t axis = 0; axis < 3; ++axis) {
                        low[axis] = (std::min)(low[axis], c[axis]);
                        high[axis] = (std::max)(high[axis], c[axis]);
                    }
                }
        if (!(low[0] <= high[0]))
            return false;
        using T = scalar_t<V>;
        Box<T> box;
        for (std::size_t axis = 0; axis < 3; ++axis)
            size = (std::max)(size, high[axis] - low[axis]);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double room = 0.5 * (high[axis] - low[axis]) + 0.02 * pixels_.largest_pixel();
            box.low[axis] = T(low[axis] - room), box.high[axis] = T(high[axis] + room);
        }
        middle = {0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]), 0.5 * (low[2] + high[2])};
        bool met = false;
        pixels_.visit_leaves(box, [&](std::uint32_t) { met = true; });
        return met;
    }

    const ReceiverPixels<V>& pixels_;
    const Refinement& rule_;
    Nodes& nodes_;
    LatticeRange tile_;
    std::size_t most_nodes_;
    std::vector<Cell> empty_; ///< blocks, by the step of their cells, none of whose nodes met anything
    std::uint64_t capped_ = 0;
};

} // namespace detail
} // namespace nephroid
