// SPDX-License-Identifier: MIT
/// @file  The nodes of a kd-tree, in depth-first order, and its leaves.
#pragma once

#include "nephroid/tree/box.hpp"

#include <cstdint>
#include <span>

namespace nephroid {

/// A node of a kd-tree. Nodes are in depth-first order. A query that misses a node's box continues at `skip`, one that
/// overlaps it at the next node, so that a search needs no stack at any depth.
template <Scalar T>
struct TreeNode {
    Box<T> box;         ///< tight around the node's points
    std::uint32_t skip; ///< the node after this one's subtree
    std::uint32_t leaf; ///< its leaf, or `no_leaf`
};

inline constexpr std::uint32_t no_leaf = (std::numeric_limits<std::uint32_t>::max)();

/// Slots [first, first + size) of the leaf order contain the leaf's points. Up to the next multiple of
/// `PointTree::lanes` they repeat the last one, so that loops over whole lanes read no points of other leaves.
struct TreeLeaf {
    std::uint32_t first;
    std::uint32_t size;
};

namespace detail {
/// Leaves start at multiples of this many slots.
inline constexpr std::size_t leaf_lanes = 16;

/// The number of slots of a leaf, including those that repeat its last point.
[[nodiscard]] constexpr std::size_t slots_of(const TreeLeaf& leaf) {
    return (leaf.size + leaf_lanes - 1) / leaf_lanes * leaf_lanes;
}

/// Calls visit(leaf) for the leaves below a node, in order, if all nodes above them are entered. Needs no stack at any
/// depth.
///
/// @param enters  enters(node's index, its box) returns whether to enter the node
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

/// Computes the inner nodes' data from their children's. Children follow their parents, so one pass backwards suffices.
///
/// @param add  add(node, child) adds the child's data to the node's
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
