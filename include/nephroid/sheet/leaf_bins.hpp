// SPDX-License-Identifier: MIT
/// @file  Blocks of sheets sorted by the leaves that they may light, so that each leaf is summed up by one thread.
#pragma once

#include "nephroid/execution/counting_sort.hpp"
#include "nephroid/execution/executor.hpp"
#include "nephroid/sheet/tile_pieces.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace nephroid::detail {

/// A block of a tile, and a leaf that it may light.
struct BinnedBlock {
    std::uint32_t tile, block, leaf;
};

/// Bins of blocks, one for each group of neighbouring leaves; in each the blocks are in the order of tiles and blocks.
class LeafBins {
public:
    explicit LeafBins(std::size_t leaves)
        : group_bits_((std::max)(1u, unsigned(std::bit_width(leaves >> 13)))), groups_((leaves >> group_bits_) + 1) {}

    [[nodiscard]] std::size_t groups() const { return groups_; }
    [[nodiscard]] std::span<const BinnedBlock> operator[](std::size_t group) const { return sorted_.items_of(group); }

    template <Vector3 V, Flux F, class E>
    void sort(std::span<const TilePieces<V, F>> tiles, E& executor) {
        constexpr std::size_t parts = 16;
        const std::size_t tiles_per_part = (tiles.size() + parts - 1) / parts;
        const auto for_each_visit = [&](std::size_t part, const auto& work) {
            const std::size_t end = (std::min)(tiles.size(), (part + 1) * tiles_per_part);
            for (std::size_t tile = part * tiles_per_part; tile < end; ++tile)
                for (const BlockVisit& visit : tiles[tile].visits)
                    work(visit.leaf >> group_bits_, BinnedBlock{std::uint32_t(tile), visit.block, visit.leaf});
        };
        sorted_.start(parts, groups_);
        executor(parts, [&](std::size_t part) {
            for_each_visit(part, [&](std::size_t group, const BinnedBlock&) { sorted_.count(part, group); });
        });
        sorted_.make_room();
        executor(parts, [&](std::size_t part) {
            for_each_visit(part,
                           [&](std::size_t group, const BinnedBlock& binned) { sorted_.put(part, group, binned); });
        });
    }

private:
    unsigned group_bits_; ///< logarithm to base 2 of the number of leaves in a group
    std::size_t groups_;
    CountingSort<BinnedBlock> sorted_; ///< by group
};

} // namespace nephroid::detail
