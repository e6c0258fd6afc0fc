// SPDX-License-Identifier: MIT
/// @file  The photons in each cell of a grid, found by a counting sort.
#pragma once

#include "nephroid/vector/language.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nephroid::detail {

/// Photons 0 to count − 1, sorted by cell. Within a cell they keep their order. `CountingSort` sorts in parallel and
/// keeps its memory; this one is made once and needs half of it.
class CellContents {
public:
    CellContents() = default;
    /// @param cells    number of cells
    /// @param count    number of photons, < 2³²
    /// @param cell_of  cell_of(i) is photon i's cell, < cells; it is called twice for each photon
    template <class CellOf>
    CellContents(std::size_t cells, std::size_t count, const CellOf& cell_of) : begin_(cells + 1, 0), photons_(count) {
        for (std::size_t i = 0; i < count; ++i)
            ++begin_[cell_of(i) + 1];
        for (std::size_t cell = 0; cell < cells; ++cell)
            begin_[cell + 1] += begin_[cell];
        std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
        for (std::size_t i = 0; i < count; ++i)
            photons_[next[cell_of(i)]++] = std::uint32_t(i);
    }

    /// The photons in a cell.
    [[nodiscard]] std::span<const std::uint32_t> operator[](std::size_t cell) const {
        return {photons_.data() + begin_[cell], begin_[cell + 1] - begin_[cell]};
    }

private:
    std::vector<std::uint32_t> begin_, photons_;
};

} // namespace nephroid::detail
