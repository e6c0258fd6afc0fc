// SPDX-License-Identifier: MIT
/// @file  A guide to light: a learned density of directions, constant in each cell of a grid.
#pragma once

#include "common/path_tracer/directions.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace nephroid::examples {

/// Cells of a grid of directions with integer weights, so that the chosen direction has exactly the returned density.
class Guide {
public:
    struct WeightedCell {
        std::uint32_t cell;
        std::uint32_t weight; ///< 1 to `full_weight`
    };
    static constexpr std::uint32_t full_weight = 255;
    static constexpr std::uint32_t edge_weight = 40; ///< of neighbours of cells in which light was seen

    Guide() = default;

    /// @param cells  sorted by cell, each once
    explicit Guide(const std::vector<WeightedCell>& cells) {
        entries_.reserve(cells.size());
        std::uint32_t sum = 0;
        for (const WeightedCell& c : cells)
            entries_.push_back({c.cell, sum += c.weight});
    }

    [[nodiscard]] bool empty() const { return entries_.empty(); }
    [[nodiscard]] std::size_t size() const { return entries_.size(); }

    struct Choice {
        std::uint32_t cell;
        double share; ///< of the weight
    };

    /// @param place  in [0, 1): a point of the cumulated weight. The list must not be empty
    [[nodiscard]] Choice choose(double place) const {
        const auto target = (std::min)(static_cast<std::uint32_t>(place * total()), total() - 1);
        const auto found = std::upper_bound(entries_.begin(), entries_.end(), target,
                                            [](std::uint32_t t, const Entry& e) { return t < e.up_to; });
        const auto i = static_cast<std::size_t>(found - entries_.begin());
        return {entries_[i].cell, weight(i) / double(total())};
    }

    /// A cell's share of the weight; 0 for one that is not in the list.
    [[nodiscard]] double share(std::uint32_t cell) const {
        const auto found = std::lower_bound(entries_.begin(), entries_.end(), cell,
                                            [](const Entry& e, std::uint32_t c) { return e.cell < c; });
        if (found == entries_.end() || found->cell != cell)
            return 0;
        return weight(static_cast<std::size_t>(found - entries_.begin())) / double(total());
    }

    /// Adds cells (in any order) that are not in the list yet, of the middle weight.
    void add(Cells cells) {
        sort_unique(cells);
        std::vector<WeightedCell> merged;
        merged.reserve(entries_.size() + cells.size());
        std::size_t i = 0;
        for (const std::uint32_t cell : cells) {
            for (; i < entries_.size() && entries_[i].cell < cell; ++i)
                merged.push_back({entries_[i].cell, weight(i)});
            if (i == entries_.size() || entries_[i].cell != cell)
                merged.push_back({cell, full_weight / 2});
        }
        for (; i < entries_.size(); ++i)
            merged.push_back({entries_[i].cell, weight(i)});
        *this = Guide(merged);
    }

private:
    struct Entry {
        std::uint32_t cell;
        std::uint32_t up_to; ///< the sum of the weights so far
    };

    [[nodiscard]] std::uint32_t total() const { return entries_.back().up_to; }
    [[nodiscard]] std::uint32_t weight(std::size_t i) const {
        return entries_[i].up_to - (i > 0 ? entries_[i - 1].up_to : 0);
    }

    std::vector<Entry> entries_;
};

/// Some cells of a grid, all alike: quick to draw from and to look up.
class CellSet {
public:
    CellSet() = default;
    /// @param cells  sorted, each once
    CellSet(const DirectionGrid& grid, Cells cells) : cells_(std::move(cells)), contains_(grid.cells()) {
        for (const std::uint32_t cell : cells_)
            contains_[cell] = true;
    }

    [[nodiscard]] bool empty() const { return cells_.empty(); }
    [[nodiscard]] std::size_t size() const { return cells_.size(); }
    /// @param place  in [0, 1); the set must not be empty
    [[nodiscard]] std::uint32_t choose(double place) const {
        return cells_[(std::min)(static_cast<std::size_t>(place * double(cells_.size())), cells_.size() - 1)];
    }
    [[nodiscard]] bool contains(std::uint32_t cell) const { return contains_[cell]; }

private:
    Cells cells_;
    std::vector<bool> contains_;
};

} // namespace nephroid::examples
