// SPDX-License-Identifier: MIT
/// @file  A batch's splats, sorted by the leaves that they overlap.
///
/// A group of leaves gets its splats in the order of their photons' indices, whichever threads sort and add them. So
/// the sums are the same bit for bit for any number of threads, without atomics or locks.
#pragma once

#include "nephroid/execution/counting_sort.hpp"
#include "nephroid/execution/executor.hpp"
#include "nephroid/splat/splat_chunk.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace nephroid::detail {

/// A splat, and one of the leaves that it overlaps.
template <class S>
struct Binned {
    const S* splat;
    std::uint32_t leaf;
    LeafMeeting meeting;
};

/// Bins of splats of one kind, one for each group of neighbouring leaves.
template <class S>
class BinsOf {
public:
    using Chunk = ChunkOf<S>;

    /// @param leaves  of the map's tree
    explicit BinsOf(std::size_t leaves)
        : group_bits_((std::max)(2u, unsigned(std::bit_width(leaves >> 13)))), groups_((leaves >> group_bits_) + 1) {}

    /// Calls add(binned) for each pair of a splat and a leaf, leaf by leaf in the order of photons. Different leaves
    /// come from different threads.
    template <class E, class Add>
    void for_each(std::span<const Chunk> chunks, E& executor, const Add& add) {
        sort(chunks, executor);
        // Neighbouring groups share cache lines, which slows down two threads that add to them. So a task has several
        // groups if enough tasks are left for many threads.
        const std::size_t groups_per_task = std::clamp<std::size_t>(groups_ / 256, 1, 4);
        for_each_index(executor, groups_, groups_per_task, [&](std::size_t group) {
            for (const Binned<S>& binned : sorted_.items_of(group))
                add(binned);
        });
    }

private:
    static constexpr std::size_t parts = 16; // with more, adding up their counts takes longer than they save

    /// Sorts the chunks' visits by group and keeps the photons' order.
    template <class E>
    void sort(std::span<const Chunk> chunks, E& executor) {
        sorted_.start(parts, groups_);
        executor(parts, [&](std::size_t part) {
            for_each_visit(chunks, part, [&](const LeafVisit& visit, const Chunk&) {
                sorted_.count(part, visit.leaf >> group_bits_);
            });
        });
        sorted_.make_room();
        executor(parts, [&](std::size_t part) {
            for_each_visit(chunks, part, [&](const LeafVisit& visit, const Chunk& chunk) {
                sorted_.put(part, visit.leaf >> group_bits_, {&chunk.splats()[visit.splat], visit.leaf, visit.meeting});
            });
        });
    }

    /// Calls work(visit, chunk) for the chunks of one part.
    template <class Work>
    void for_each_visit(std::span<const Chunk> chunks, std::size_t part, const Work& work) const {
        const std::size_t chunks_per_part = (chunks.size() + parts - 1) / parts;
        const std::size_t end = (std::min)(chunks.size(), (part + 1) * chunks_per_part);
        for (std::size_t chunk = part * chunks_per_part; chunk < end; ++chunk)
            for (const LeafVisit& visit : chunks[chunk].visits())
                work(visit, chunks[chunk]);
    }

    /// Logarithm to base 2 of the number of leaves in a group. Four leaves stay in the first-level cache while one
    /// thread adds to them. Larger trees have larger groups, so that there are at most 8192 of them to count visits to.
    unsigned group_bits_;
    std::size_t groups_;
    CountingSort<Binned<S>> sorted_; // by group
};

} // namespace nephroid::detail
