// SPDX-License-Identifier: MIT
/// @file  The nodes of a chart, found by their integer places: the regular ones of a sector, and those that a tile adds
///        between them.
#pragma once

#include "nephroid/execution/executor.hpp"
#include "nephroid/sheet/lattice.hpp"
#include "nephroid/sheet/node_end.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

namespace nephroid::detail {

/// The regular nodes of a range of cells and of a ring of two cells around it, traced by several threads.
template <Vector3 V, Flux F>
class NodeGrid {
public:
    using Node = NodeEnd<V, F>;
    static constexpr std::int64_t ring = 2;

    /// How many tasks `fill` gives to its executor.
    [[nodiscard]] static std::size_t tasks_of(const Lattice& lattice, const CellRange& cells) {
        const auto squares = [](std::int64_t nodes) { return std::size_t((nodes + width - 1) / width); };
        return squares(columns_of(lattice, cells)) * squares(rows_of(lattice, cells));
    }

    /// @param trace  trace(place, ends, task): appends the ends of a node; called from several threads
    template <class Trace, class E>
    void fill(const Lattice& lattice, const CellRange& cells, const Trace& trace, E& executor) {
        const std::int64_t step = lattice.step();
        step_ = step;
        begin_u_ = (std::max)(std::int64_t(0), cells.begin_u - ring);
        begin_v_ = (std::max)(std::int64_t(0), cells.begin_v - ring);
        columns_ = columns_of(lattice, cells);
        rows_ = rows_of(lattice, cells);
        ranges_.assign(std::size_t(columns_ * rows_), {});
        // In squares, so that neighbours are traced one after the other: their rays meet the same things.
        const auto tasks_across = std::size_t((columns_ + width - 1) / width),
                   tasks = tasks_across * std::size_t((rows_ + width - 1) / width);
        if (pools_.size() < tasks)
            pools_.resize(tasks);
        executor(tasks, [&](std::size_t task) {
            std::vector<Node>& pool = pools_[task];
            pool.clear();
            const std::int64_t from_i = std::int64_t(task % tasks_across) * width,
                               from_j = std::int64_t(task / tasks_across) * width;
            for (std::int64_t j = from_j; j < (std::min)(rows_, from_j + width); ++j)
                for (std::int64_t i = from_i; i < (std::min)(columns_, from_i + width); ++i) {
                    const auto first = std::uint32_t(pool.size());
                    trace(LatticePlace{(begin_u_ + i) * step, (begin_v_ + j) * step}, pool, task);
                    ranges_[index(i, j)] = {std::uint32_t(task), first, std::uint32_t(pool.size()) - first};
                }
        });
    }

    /// Whether a regular node of this range is at a place.
    [[nodiscard]] bool has(const LatticePlace& p) const {
        if (((p.i | p.j) & (step_ - 1)) != 0)
            return false;
        const std::int64_t i = p.i / step_ - begin_u_, j = p.j / step_ - begin_v_;
        return i >= 0 && j >= 0 && i < columns_ && j < rows_;
    }

    [[nodiscard]] NodeEnds<V, F> operator[](const LatticePlace& p) const {
        const Range& range = ranges_[index(p.i / step_ - begin_u_, p.j / step_ - begin_v_)];
        return {pools_[range.pool].data() + range.first, range.size};
    }

    [[nodiscard]] std::size_t size() const { return ranges_.size(); }
    /// Memory of the nodes and their ends.
    [[nodiscard]] std::size_t bytes() const {
        std::size_t ends = 0;
        for (const std::vector<Node>& pool : pools_)
            ends += pool.size();
        return ranges_.size() * sizeof(Range) + ends * sizeof(Node);
    }

private:
    static constexpr std::int64_t width = 16;

    struct Range {
        std::uint32_t pool, first, size;
    };

    [[nodiscard]] static std::int64_t columns_of(const Lattice& lattice, const CellRange& cells) {
        return (std::min)(lattice.cells_u, cells.end_u + ring) + 1 - (std::max)(std::int64_t(0), cells.begin_u - ring);
    }
    [[nodiscard]] static std::int64_t rows_of(const Lattice& lattice, const CellRange& cells) {
        return (std::min)(lattice.cells_v, cells.end_v + ring) + 1 - (std::max)(std::int64_t(0), cells.begin_v - ring);
    }
    [[nodiscard]] std::size_t index(std::int64_t i, std::int64_t j) const { return std::size_t(j * columns_ + i); }

    std::int64_t step_ = 1, begin_u_ = 0, begin_v_ = 0, columns_ = 0, rows_ = 0;
    std::vector<Range> ranges_;
    std::vector<std::vector<Node>> pools_;
};

/// The nodes that one tile uses: those of the grid, and its own, which are traced when they are first asked for.
template <Vector3 V, Flux F, class Trace>
class NodeCache {
public:
    using Node = NodeEnd<V, F>;

    /// @param trace  trace(place, ends): appends the ends of a node
    NodeCache(const NodeGrid<V, F>& grid, const Lattice& lattice, Trace trace)
        : grid_(grid), lattice_(lattice), trace_(std::move(trace)) {}

    /// The ends of a node, which is traced if it has not been; none beyond the chart.
    [[nodiscard]] NodeEnds<V, F> at(const LatticePlace& p) {
        if (!is_inside(p))
            return {};
        if (grid_.has(p))
            return grid_[p];
        const auto [found, is_new] = own_.try_emplace(key(p));
        if (is_new)
            trace_(p, found->second);
        return found->second;
    }

    /// The ends of a node that has been traced; none of others.
    [[nodiscard]] NodeEnds<V, F> known(const LatticePlace& p) const {
        if (!is_inside(p))
            return {};
        if (grid_.has(p))
            return grid_[p];
        const auto found = own_.find(key(p));
        return found == own_.end() ? NodeEnds<V, F>{} : NodeEnds<V, F>(found->second);
    }

    [[nodiscard]] std::size_t added() const { return own_.size(); }

private:
    [[nodiscard]] bool is_inside(const LatticePlace& p) const {
        return p.i >= 0 && p.j >= 0 && p.i <= lattice_.cells_u * lattice_.step() &&
               p.j <= lattice_.cells_v * lattice_.step();
    }

    [[nodiscard]] static std::uint64_t key(const LatticePlace& p) {
        return static_cast<std::uint64_t>(p.i) << 32 ^ static_cast<std::uint64_t>(p.j);
    }

    struct Scatter {
        [[nodiscard]] std::size_t operator()(std::uint64_t k) const {
            return static_cast<std::size_t>((k ^ k >> 29) * 0x9e3779b97f4a7c15u >> 7);
        }
    };

    const NodeGrid<V, F>& grid_;
    const Lattice& lattice_;
    Trace trace_;
    std::unordered_map<std::uint64_t, std::vector<Node>, Scatter> own_; ///< spans of its elements stay valid
};

} // namespace nephroid::detail
