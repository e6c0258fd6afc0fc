// SPDX-License-Identifier: MIT
/// @file  A tree's nodes eight at a time: what a look-up goes through.
#pragma once

#include "nephroid/tree/tree_node.hpp"

#include <algorithm>
#include <span>
#include <vector>

namespace nephroid::detail {

/// The same tree with eight children a node, whose boxes lie together coordinate by coordinate: they are tested in a
/// few vector instructions, without a branch that goes either way at every node of the binary tree.
template <Scalar T>
class WideTree {
public:
    static constexpr std::size_t width = 8;

    struct Node {
        std::array<std::array<T, width>, 3> low, high; ///< of the children; an absent one has an empty box
        std::array<std::uint32_t, width> child;        ///< a wide node, or a leaf's number with `leaf_flag`
        std::array<std::uint32_t, width> source;       ///< the node of the binary tree that each child is
    };
    static constexpr std::uint32_t leaf_flag = 0x80000000u;

    WideTree() = default;

    /// @param nodes  in depth-first order, at most 2³¹ of them
    explicit WideTree(std::span<const TreeNode<T>> nodes) {
        if (nodes.empty())
            return;
        nodes_.reserve(nodes.size() / 8 + 1);
        std::vector<std::uint32_t> roots{0}; // of the wide nodes, as far as they are known
        for (std::size_t i = 0; i < roots.size(); ++i)
            add(nodes, roots[i], roots);
        refit(nodes);
    }

    /// Takes the boxes anew from nodes that have moved.
    void refit(std::span<const TreeNode<T>> nodes) {
        constexpr T infinity = std::numeric_limits<T>::infinity();
        for (Node& node : nodes_)
            for (std::size_t i = 0; i < width; ++i) {
                const bool absent = node.source[i] == no_leaf;
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    node.low[axis][i] = absent ? infinity : nodes[node.source[i]].box.low[axis];
                    node.high[axis][i] = absent ? -infinity : nodes[node.source[i]].box.high[axis];
                }
            }
    }

    /// Calls visit(leaf) for every leaf whose box overlaps this one, in leaf order.
    template <class Visit>
    void visit_leaves(std::span<const TreeNode<T>> nodes, const Box<T>& box, Visit&& visit) const {
        walk(
            nodes, [&](const Node& node) { return overlaps(node, box); },
            [&](const TreeNode<T>& node) { return node.box.overlaps(box); }, visit);
    }

    /// The leaf whose box is nearest to a point, by the boxes' Chebyshev distance; there must be one.
    [[nodiscard]] std::uint32_t nearest_leaf(std::span<const TreeNode<T>> nodes, const std::array<T, 3>& p) const {
        // Down to a near leaf first: most points lie in it, and for the others it leaves little to search.
        std::uint32_t found = 0;
        T best(0);
        do {
            const std::array<T, width> distance = distances(nodes_[found], p);
            std::size_t nearest = 0;
            for (std::size_t i = 1; i < width; ++i)
                nearest = distance[i] < distance[nearest] ? i : nearest;
            best = distance[nearest];
            found = nodes_[found].child[nearest];
        } while ((found & leaf_flag) == 0);
        found &= ~leaf_flag;
        if (!(best > T(0)))
            return found;
        for (std::size_t i = 0; i < nodes.size();) {
            const T distance = distance_to(nodes[i].box, p);
            if (!(distance < best)) {
                i = nodes[i].skip;
                continue;
            }
            if (nodes[i].leaf != no_leaf) {
                best = distance;
                found = nodes[i].leaf;
            }
            ++i;
        }
        return found;
    }

private:
    /// 1 for each child whose box overlaps this one, else 0.
    [[nodiscard]] static std::array<std::uint32_t, width> overlaps(const Node& node, const Box<T>& box) {
        std::array<std::uint32_t, width> overlap;
#pragma GCC unroll 1 // else GCC unrolls it, and then does not vectorise it
        for (std::size_t i = 0; i < width; ++i)
            overlap[i] = std::uint32_t(int(node.source[i] != no_leaf) & // a box may be endless
                                       int(node.low[0][i] <= box.high[0]) & int(box.low[0] <= node.high[0][i]) &
                                       int(node.low[1][i] <= box.high[1]) & int(box.low[1] <= node.high[1][i]) &
                                       int(node.low[2][i] <= box.high[2]) & int(box.low[2] <= node.high[2][i]));
        return overlap;
    }

    [[nodiscard]] static std::array<T, width> distances(const Node& node, const std::array<T, 3>& p) {
        std::array<T, width> distance;
        const auto larger = [](const T& a, const T& b) { return a > b ? a : b; };
        const T x = p[0], y = p[1], z = p[2];
#pragma GCC unroll 1
        for (std::size_t i = 0; i < width; ++i) {
            const T beside_x = larger(node.low[0][i] - x, x - node.high[0][i]);
            const T beside_y = larger(node.low[1][i] - y, y - node.high[1][i]);
            const T beside_z = larger(node.low[2][i] - z, z - node.high[2][i]);
            distance[i] = larger(larger(beside_x, beside_y), larger(beside_z, T(0)));
        }
        return distance;
    }

    [[nodiscard]] static T distance_to(const Box<T>& box, const std::array<T, 3>& p) {
        T distance(0);
        for (std::size_t axis = 0; axis < 3; ++axis)
            distance = (std::max)({distance, box.low[axis] - p[axis], p[axis] - box.high[axis]});
        return distance;
    }

    /// Goes through the tree in order.
    ///
    /// @param choose  choose(wide node) -> 1 for each child to go into, else 0
    /// @param enters  enters(binary node) -> whether to go into it
    /// @param visit   visit(leaf)
    template <class Choose, class Enters, class Visit>
    void walk(std::span<const TreeNode<T>> nodes, const Choose& choose, const Enters& enters, Visit& visit) const {
        if (nodes_.empty())
            return;
        struct Pending {
            std::uint32_t child, source;
        };
        // A tree too deep for this (points clustered over hundreds of orders of two) has the rest of a branch walked in
        // the binary nodes' own order, which needs no room.
        constexpr std::size_t most_pending = 128;
        std::array<Pending, most_pending + width> pending;
        std::size_t top = 0;
        std::uint32_t child = 0, source = 0;
        for (;;) {
            if ((child & leaf_flag) != 0) {
                visit(child & ~leaf_flag);
            } else if (top > most_pending) {
                walk_binary(nodes, source, enters, visit);
            } else {
                const Node& node = nodes_[child];
                const std::array<std::uint32_t, width> chosen = choose(node);
                for (std::size_t i = width; i-- > 0;) { // the first one on top
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

    template <class Enters, class Visit>
    static void walk_binary(std::span<const TreeNode<T>> nodes, std::size_t root, const Enters& enters, Visit& visit) {
        for (std::size_t i = root; i < nodes[root].skip;) {
            if (!enters(nodes[i])) {
                i = nodes[i].skip;
                continue;
            }
            if (nodes[i].leaf != no_leaf)
                visit(nodes[i].leaf);
            ++i;
        }
    }

    /// The node of a binary node's children, and theirs: the one with the most nodes below it is replaced by its two
    /// until there are eight.
    void add(std::span<const TreeNode<T>> nodes, std::uint32_t root, std::vector<std::uint32_t>& roots) {
        std::array<std::uint32_t, width> members;
        std::size_t count = 1;
        members[0] = root;
        const auto size = [&](std::uint32_t i) { return nodes[i].skip - i; };
        while (count < width) {
            std::size_t largest = 0;
            for (std::size_t i = 1; i < count; ++i)
                if (size(members[i]) > size(members[largest]))
                    largest = i;
            const std::uint32_t parent = members[largest];
            if (nodes[parent].leaf != no_leaf)
                break;
            for (std::size_t i = count++; i > largest + 1; --i)
                members[i] = members[i - 1];
            members[largest] = parent + 1;
            members[largest + 1] = nodes[parent + 1].skip;
        }
        Node node{};
        for (std::size_t i = 0; i < width; ++i) {
            node.source[i] = i < count ? members[i] : no_leaf;
            if (i >= count)
                continue;
            const std::uint32_t leaf = nodes[members[i]].leaf;
            node.child[i] = leaf != no_leaf ? leaf | leaf_flag : std::uint32_t(roots.size());
            if (leaf == no_leaf)
                roots.push_back(members[i]);
        }
        nodes_.push_back(node);
    }

    std::vector<Node> nodes_;
};

} // namespace nephroid::detail
