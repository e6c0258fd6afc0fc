// SPDX-License-Identifier: MIT
/// @file  Edges of patches in groups as wide as a vector register, and the memory for them.
#pragma once

#include "nephroid/vector/scalar.hpp"

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace nephroid::detail {

/// Eight edges side by side, from a to b relative to the block's middle; `jump` 0 where there is none.
template <Scalar T>
struct EdgeGroup {
    static constexpr std::size_t lanes = 8;
    std::array<std::array<T, lanes>, 3> a, b;
    std::array<T, lanes> jump;
};

/// Memory for groups of edges. A group stays where it is until all are cleared.
template <Scalar T>
class EdgePages {
public:
    static constexpr std::size_t page_size = 256; ///< groups: 56 KiB of floats

    /// Returns room for this many consecutive groups, at most a page.
    [[nodiscard]] std::span<EdgeGroup<T>> add(std::size_t groups) {
        if (pages_.empty() || used_ + groups > page_size) {
            page_ += std::size_t(!pages_.empty());
            if (page_ == pages_.size())
                pages_.emplace_back(new EdgeGroup<T>[page_size]); // not set to zero
            used_ = 0;
        }
        const std::span<EdgeGroup<T>> room(pages_[page_].get() + used_, groups);
        used_ += groups;
        return room;
    }

    /// Removes all groups, and keeps the memory.
    void clear() { page_ = used_ = 0; }

private:
    std::vector<std::unique_ptr<EdgeGroup<T>[]>> pages_;
    std::size_t page_ = 0, used_ = 0; ///< where the next group goes
};

} // namespace nephroid::detail
