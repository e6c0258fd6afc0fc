// SPDX-License-Identifier: MIT
/// @file  What a kd-tree is made of: nodes in depth-first order, and leaves.
#pragma once

#include "nephroid/tree/box.hpp"

#include <cstdint>
#include <span>

namespace nephroid {

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

namespace detail {
/// Leaves start at multiples of this many slots.
inline constexpr std::size_t leaf_lanes = 16;

/// How many slots a leaf takes, those that repeat its last point included.
[[nodiscard]] constexpr std::size_t slots_of(const TreeLeaf& leaf) {
    return (leaf.size + leaf_lanes - 1) / leaf_lanes * leaf_lanes;
}

/// Calls visit(leaf) for the leaves below a node, in their order, of which every node on the way is entered. Needs no
/// room, whatever the depth.
///
/// @param enters  enters(node's number, its box) -> whether to go into it
/// @param visit   visit(leaf)
template <Scalar T, class Enters, class Visit>
constexpr void walk_nodes(std::span<const TreeNode<T>> nodes, std::uint32_t root, const Enters& enters, Visit& visit) {
    for (std::uint32_t i = root; i < nodes[root].skip;) {
        if (!enters(i, nodes[i].box)) {
            i = nodes[i].skip;
            continue;
        }
        if (nodes[i].leaf != no_leaf)
            visit(nodes[i].leaf);
        ++i;
    }
}

/// Gives the inner nodes what holds all that is below them. Children follow their parents: one pass backwards.
///
/// @param add  add(node, child): adds to what the node has what the child has
template <Scalar T, class Add>
void gather_upwards(std::span<const TreeNode<T>> nodes, const Add& add) {
    for (std::size_t i = nodes.size(); i-- > 0;)
        if (nodes[i].leaf == no_leaf) {
            add(i, i + 1);
            add(i, std::size_t(nodes[i + 1].skip));
        }
}
} // namespace detail

} // namespace nephroid
