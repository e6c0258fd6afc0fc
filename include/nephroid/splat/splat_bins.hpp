// SPDX-License-Identifier: MIT
/// @file  A batch's splats, sorted by the leaves that they meet.
///
/// A group of leaves gets its splats in the order of their photons' indices, whoever sorts them and whoever sums them
/// up, so that the sums are the same bit for bit for any number of threads, without atomics or locks.
#pragma once

#include "nephroid/splat/splat_chunk.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace nephroid::detail {

/// A splat, and a leaf that it meets.
template <Vector3 V, Flux F>
struct BinnedSplat {
    const Splat<V, F>* splat;
    std::uint32_t leaf;
    LeafMeeting meeting;
};

/// One bin for each group of neighbouring leaves.
template <Vector3 V, Flux F>
class SplatBins {
public:
    using Chunk = SplatChunk<V, F>;

    /// @param leaves  of the map's tree
    explicit SplatBins(std::size_t leaves)
        : group_bits_((std::max)(2u, unsigned(std::bit_width(leaves >> 13)))), groups_((leaves >> group_bits_) + 1) {}

    [[nodiscard]] std::size_t groups() const { return groups_; }

    /// The splats of one group, in the order of their photons, as long as the chunks stay as they are.
    [[nodiscard]] std::span<const BinnedSplat<V, F>> operator[](std::size_t group) const {
        return std::span(bins_).subspan(begin_[group], begin_[group + 1] - begin_[group]);
    }

    /// Sorts the chunks' visits by group, keeping the photons' order: a counting sort, of which 16 parts count and move
    /// their visits at the same time. More would take longer to add up than they save.
    template <class E>
    void sort(std::span<const Chunk> chunks, E& executor) {
        next_.assign(parts * groups_, 0);
        executor(parts, [&](std::size_t part) {
            for_each_visit(chunks, part, [](std::size_t& visits, const LeafVisit&, const Chunk&) { ++visits; });
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
            for_each_visit(chunks, part, [this](std::size_t& next, const LeafVisit& visit, const Chunk& chunk) {
                bins_[next++] = {&chunk.splats()[visit.splat], visit.leaf, visit.meeting};
            });
        });
    }

private:
    static constexpr std::size_t parts = 16;

    /// Calls work(counter of the part's visits to the group, visit, chunk) for the chunks of one part.
    template <class Work>
    void for_each_visit(std::span<const Chunk> chunks, std::size_t part, const Work& work) {
        const std::size_t chunks_per_part = (chunks.size() + parts - 1) / parts;
        const std::size_t end = (std::min)(chunks.size(), (part + 1) * chunks_per_part);
        for (std::size_t chunk = part * chunks_per_part; chunk < end; ++chunk)
            for (const LeafVisit& visit : chunks[chunk].visits())
                work(next_[part * groups_ + (visit.leaf >> group_bits_)], visit, chunks[chunk]);
    }

    /// How many neighbouring leaves one thread sums up together, as a power of two: four, which stay in the nearest
    /// cache, or what makes 8192 groups at most, as each part of a batch counts its visits to each.
    unsigned group_bits_;
    std::size_t groups_;
    std::vector<BinnedSplat<V, F>> bins_;
    std::vector<std::size_t> begin_; // of each group in the bins, and their end
    std::vector<std::size_t> next_;  // by part of the batch, then group: where its next visit goes
};

} // namespace nephroid::detail
