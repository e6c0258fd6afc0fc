// SPDX-License-Identifier: MIT
/// @file  What a kd-tree is made of: boxes, nodes in depth-first order, leaves.
#pragma once

#include "nephroid/vector/scalar.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace nephroid {

/// An axis-aligned box relative to a tree's origin.
template <Scalar T>
struct Box {
    std::array<T, 3> low, high;

    [[nodiscard]] bool overlaps(const Box& other) const {
        // Bitwise: the three axes are tested without a branch each.
        return bool(int(low[0] <= other.high[0]) & int(other.low[0] <= high[0]) & int(low[1] <= other.high[1]) &
                    int(other.low[1] <= high[1]) & int(low[2] <= other.high[2]) & int(other.low[2] <= high[2]));
    }
};

/// A kd-tree's nodes in depth-first order. A query that misses a node's box goes on at `skip`, one that meets it at
/// the next node: the walk needs no stack, whatever the depth.
template <Scalar T>
struct TreeNode {
    Box<T> box;         ///< tight about the node's points
    std::uint32_t skip; ///< the node after this one's subtree
    std::uint32_t leaf; ///< its leaf, or `no_leaf`
};

inline constexpr std::uint32_t no_leaf = (std::numeric_limits<std::uint32_t>::max)();

/// Slots [first, first + size) of the leaf order hold points; up to the next multiple of `PointTree::lanes` they
/// repeat the last one, so that loops over whole lanes read nothing foreign.
struct TreeLeaf {
    std::uint32_t first;
    std::uint32_t size;
};

} // namespace nephroid
