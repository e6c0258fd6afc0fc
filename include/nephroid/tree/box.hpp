// SPDX-License-Identifier: MIT
/// @file  An axis-aligned box.
#pragma once

#include "nephroid/vector/scalar.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace nephroid {

/// An axis-aligned, closed box relative to a tree's origin. It may be flat, and is empty if low > high.
template <Scalar T>
struct Box {
    std::array<T, 3> low, high;

    [[nodiscard]] constexpr bool overlaps(const Box& other) const {
        // Bitwise operators, so that the three axes are tested without branches.
        return bool(int(low[0] <= other.high[0]) & int(other.low[0] <= high[0]) & int(low[1] <= other.high[1]) &
                    int(other.low[1] <= high[1]) & int(low[2] <= other.high[2]) & int(other.low[2] <= high[2]));
    }

    /// Grows to contain another box.
    constexpr void add(const Box& other) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            low[axis] = (std::min)(low[axis], other.low[axis]);
            high[axis] = (std::max)(high[axis], other.high[axis]);
        }
    }
};

namespace detail {
/// The empty box; adding a box to it gives that box.
template <Scalar T>
[[nodiscard]] constexpr Box<T> empty_box() {
    constexpr T infinity = std::numeric_limits<T>::infinity();
    return {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
}
} // namespace detail

} // namespace nephroid
