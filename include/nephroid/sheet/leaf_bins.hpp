// SPDX-License-Identifier: MIT
/// @file  Blocks of sheets sorted by the leaves that they may light, so that each leaf is summed up by one thread.
#pragma once

#include "nephroid/execution/executor.hpp"
#include "nephroid/sheet/tile_pieces.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace nephroid::detail {

/// A block of a tile, and a leaf that it may light.
struct BinnedBlock {
    std::uint32_t tile, block, leaf;
};

/// Visits by groups of neighbouring leaves, within a group in the order of tiles and blocks.
class LeafBins {
public:
    explicit LeafBins(std::size_t leaves)
        : bits_((std::max)(1u, unsigned(std::bit_width(leaves >> 13)))), groups_((leaves >> bits_) + 1) {}

    [[nodiscard]] std::size_t groups() const { return groups_; }
    [[nodiscard]] std::span<const BinnedBlock> operator[](std::size_t group) const {
        return {bins_.data() + begin_[group], begin_[group + 1] - begin_[group]};
    }

    /// A counting sort, of which 16 parts count and move their visits at the same time.
    template <Vector3 V, Flux F, class E>
    void sort(std::span<const TilePieces<V, F>> tiles, E& executor) {
        constexpr std::size_t parts = 16;
        const std::size_t tiles_per_part = (tiles.size() + parts - 1) / parts;
        const auto for_each_visit = [&](std::size_t part, const auto& work) {
            const std::size_t end = (std::min)(tiles.size(), (part + 1) * tiles_per_part);
            for (std::size_t tile = part * tiles_per_part; tile < end; ++tile)
                for (const BlockVisit& visit : tiles[tile].visits)
                    work(next_[part * groups_ + (visit.leaf >> bits_)],
                         BinnedBlock{std::uint32_t(tile), visit.block, visit.leaf});
        };
        next_.assign(parts * groups_, 0);
        executor(parts, [&](std::size_t part) {
            for_each_visit(part, [](std::size_t& visits, const BinnedBlock&) { ++visits; });
        });
        begin_.resize(groups_ + 1);
        std::size_t sum = 0;
        for (std::size_t group = 0; group < groups_; ++group) {
            begin_[group] = sum;
            for (std::size_t part = 0; part < parts; ++part)
                sum += std::exchange(next_[part * groups_ + group], sum);
        }
        begin_[groups_] = sum;
        bins_.resize(sum);
        executor(parts, [&](std::size_t part) {
            for_each_visit(part, [this](std::size_t& next, const BinnedBlock& binned) { bins_[next++] = binned; });
        });
    }

private:
    unsigned bits_;
    std::size_t groups_;
    std::vector<BinnedBlock> bins_;
    std::vector<std::size_t> begin_; ///< of each group in the bins, and their end
    std::vector<std::size_t> next_;  ///< by part, then group: where its next visit goes
};

} // namespace nephroid::detail
