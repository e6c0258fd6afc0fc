// SPDX-License-Identifier: MIT
/// @file  A kd-tree's node with eight children, and the traversal of such nodes.
#pragma once

#include "nephroid/tree/tree_node.hpp"
#include "nephroid/vector/not_unrolled.hpp"

namespace nephroid::detail {

/// A node with eight children. Their boxes are stored coordinate by coordinate, so that they are tested with a few
/// vector instructions instead of an unpredictable branch at every node of the binary tree.
template <Scalar T>
struct WideNode {
    static constexpr std::size_t width = 8;
    static constexpr std::uint32_t leaf_flag = 0x80000000u;

    std::array<std::array<T, width>, 3> low, high; ///< of the children; an absent one has an empty box
    std::array<std::uint32_t, width> child;        ///< index of a wide node, or of a leaf with `leaf_flag`
    std::array<std::uint32_t, width> source;       ///< each child's node in the binary tree; `no_leaf` if absent

    /// 1 for each child whose box overlaps a given one, 0 for the others.
    [[nodiscard]] std::array<std::uint32_t, width> overlaps(const Box<T>& box) const {
        std::array<std::uint32_t, width> overlap;
        NEPHROID_NOT_UNROLLED
        for (std::size_t i = 0; i < width; ++i)
            overlap[i] = std::uint32_t(int(source[i] != no_leaf) & // a box may be endless
                                       int(low[0][i] <= box.high[0]) & int(box.low[0] <= high[0][i]) &
                                       int(low[1][i] <= box.high[1]) & int(box.low[1] <= high[1][i]) &
                                       int(low[2][i] <= box.high[2]) & int(box.low[2] <= high[2][i]));
        return overlap;
    }

    [[nodiscard]] Box<T> box(std::size_t i) const {
        return {{low[0][i], low[1][i], low[2][i]}, {high[0][i], high[1][i], high[2][i]}};
    }

    /// The Chebyshev distance of each child's box from a point.
    [[nodiscard]] std::array<T, width> distances(const std::array<T, 3>& position) const {
        std::array<T, width> distance;
        const auto larger = [](const T& a, const T& b) { return a > b ? a : b; };
        const T x = position[0], y = position[1], z = position[2];
        NEPHROID_NOT_UNROLLED
        for (std::size_t i = 0; i < width; ++i) {
            const T beside_x = larger(low[0][i] - x, x - high[0][i]);
            const T beside_y = larger(low[1][i] - y, y - high[1][i]);
            const T beside_z = larger(low[2][i] - z, z - high[2][i]);
            distance[i] = larger(larger(beside_x, beside_y), larger(beside_z, T(0)));
        }
        return distance;
    }
};

/// Size of the traversal's stack. If a tree is too deep for it (points clustered over hundreds of powers of two), the
/// subtree is traversed in the binary nodes' own order, which needs no stack.
inline constexpr std::size_t most_pending = 128;

/// Traverses a tree in leaf order.
///
/// @param wide    the tree's wide nodes
/// @param nodes   its binary nodes
/// @param choose  choose(wide node) returns 1 for each child to enter, 0 for the others
/// @param enters  enters(binary node's index, its box) returns the same for a single node
/// @param visit   visit(leaf)
template <Scalar T, class Choose, class Enters, class Visit>
void walk_wide(std::span<const WideNode<T>> wide, std::span<const TreeNode<T>> nodes, const Choose& choose,
               const Enters& enters, Visit& visit) {
    using Node = WideNode<T>;
    if (wide.empty())
        return;
    struct Pending {
        std::uint32_t child, source;
    };
    std::array<Pending, most_pending + 8> pending;
    std::size_t top = 0;
    std::uint32_t child = 0, source = 0;
    for (;;) {
        if ((child & Node::leaf_flag) != 0) {
            visit(child & ~Node::leaf_flag);
        } else if (top > most_pending) {
            walk_nodes(nodes, source, enters, visit);
        } else {
            const Node& node = wide[child];
            const std::array<std::uint32_t, Node::width> chosen = choose(node);
            for (std::size_t i = Node::width; i-- > 0;) { // so that the first child is on top of the stack
                pending[top] = {node.child[i], node.source[i]};
                top += chosen[i];
            }
        }
        if (top == 0)
            return;
        child = pending[--top].child;
        source = pending[top].source;
    }
}

/// Calls visit(leaf) for every leaf whose box overlaps a given one, in leaf order.
template <Scalar T, class Visit>
void visit_overlapping(std::span<const WideNode<T>> wide, std::span<const TreeNode<T>> nodes, const Box<T>& box,
                       Visit& visit) {
    walk_wide(
        wide, nodes, [&](const WideNode<T>& node) { return node.overlaps(box); },
        [&](std::uint32_t, const Box<T>& other) { return other.overlaps(box); }, visit);
}

/// Calls visit(leaf) for every leaf that is entered together with all nodes above it, in leaf order.
///
/// @param enters  enters(binary node's index, its box) returns whether to enter it
template <Scalar T, class Enters, class Visit>
void visit_entered(std::span<const WideNode<T>> wide, std::span<const TreeNode<T>> nodes, const Enters& enters,
                   Visit& visit) {
    const auto choose = [&](const WideNode<T>& node) {
        std::array<std::uint32_t, WideNode<T>::width> chosen{};
        for (std::size_t i = 0; i < chosen.size() && node.source[i] != no_leaf; ++i) // absent children come last
            chosen[i] = std::uint32_t(bool(enters(node.source[i], node.box(i))));
        return chosen;
    };
    walk_wide(wide, nodes, choose, enters, visit);
}

} // namespace nephroid::detail
