// SPDX-License-Identifier: MIT
/// @file  Searches a tree for the nearest points, the nearer child first.
#pragma once

#include "nephroid/tree/nearest_points.hpp"
#include "nephroid/tree/tree_node.hpp"

namespace nephroid::detail {

/// One search in a PointTreeView.
template <class Tree, class Accept>
class NearestSearch {
public:
    using T = typename Tree::T;
    using Position = std::array<T, 3>;

    NearestSearch(const Tree& tree, const Position& position, const Accept& accept)
        : tree_(&tree), position_(position), accept_(&accept) {}

    /// @param nearest  collects the points
    void run(NearestPoints<T>& nearest) const {
        const std::span<const TreeNode<T>> nodes = tree_->nodes();
        struct Waiting {
            T distance2;
            std::uint32_t node;
        };
        std::array<Waiting, most_waiting> waiting;
        std::size_t top = 0;
        T distance2 = distance2_to(nodes[0].box);
        for (std::uint32_t node = 0;;) {
            if (nearest.wants(distance2)) {
                if (nodes[node].leaf != no_leaf) {
                    take_leaf(nodes[node].leaf, nearest);
                } else if (top == most_waiting) {
                    take_subtree(node, nearest);
                } else {
                    const std::uint32_t first = node + 1, second = nodes[first].skip;
                    const T to_first = distance2_to(nodes[first].box), to_second = distance2_to(nodes[second].box);
                    const bool in_order = to_first <= to_second;
                    waiting[top++] = in_order ? Waiting{to_second, second} : Waiting{to_first, first};
                    node = in_order ? first : second;
                    distance2 = in_order ? to_first : to_second;
                    continue;
                }
            }
            if (top == 0)
                break;
            node = waiting[--top].node;
            distance2 = waiting[top].distance2;
        }
    }

private:
    /// The other children wait on a stack of this size. If a tree is too deep for it (points clustered over hundreds of
    /// powers of two), the subtree is searched in the nodes' own order, which needs no stack.
    static constexpr std::size_t most_waiting = 64;

    [[nodiscard]] T distance2_to(const Box<T>& box) const {
        const auto larger = [](const T& a, const T& b) { return a > b ? a : b; };
        const auto beside = [&](std::size_t axis) {
            return larger(larger(box.low[axis] - position_[axis], position_[axis] - box.high[axis]), T(0));
        };
        return square(beside(0)) + square(beside(1)) + square(beside(2));
    }

    void take_leaf(std::uint32_t number, NearestPoints<T>& nearest) const {
        constexpr std::size_t lanes = Tree::lanes;
        const TreeLeaf leaf = tree_->leaves()[number];
        for (std::uint32_t first = 0; first < leaf.size; first += lanes) {
            std::array<T, Tree::lanes> distance2;
            tree_->distances2(leaf.first + first, position_, distance2);
            const std::size_t size = (std::min)(lanes, std::size_t(leaf.size - first));
            nearest.offer(distance2, size, leaf.first + first, *accept_);
        }
    }

    void take_subtree(std::uint32_t root, NearestPoints<T>& nearest) const {
        const auto is_wanted = [&](std::uint32_t, const Box<T>& box) { return nearest.wants(distance2_to(box)); };
        const auto take = [&](std::uint32_t leaf) { take_leaf(leaf, nearest); };
        walk_nodes(tree_->nodes(), root, is_wanted, take);
    }

    const Tree* tree_;
    Position position_;
    const Accept* accept_;
};

} // namespace nephroid::detail
