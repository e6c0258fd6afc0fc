// SPDX-License-Identifier: MIT
/// @file  The wide nodes of a kd-tree, for searches with vector instructions.
#pragma once

#include "nephroid/tree/wide_node.hpp"

#include <vector>

namespace nephroid::detail {

/// A binary tree converted to nodes with eight children.
template <Scalar T>
class WideTree {
public:
    using Node = WideNode<T>;

    WideTree() = default;

    /// @param nodes  in depth-first order, at most 2³¹ of them
    explicit WideTree(std::span<const TreeNode<T>> nodes) {
        if (nodes.empty())
            return;
        nodes_.reserve(nodes.size() / 8 + 1);
        std::vector<std::uint32_t> roots{0}; // the binary nodes of the wide nodes known so far
        for (std::size_t i = 0; i < roots.size(); ++i)
            add(nodes, roots[i], roots);
        refit(nodes);
    }

    [[nodiscard]] std::span<const Node> nodes() const { return {nodes_.data(), nodes_.size()}; }

    /// Updates the boxes after the binary nodes' boxes have changed.
    void refit(std::span<const TreeNode<T>> nodes) {
        for (Node& node : nodes_)
            for (std::size_t i = 0; i < Node::width; ++i) {
                const Box<T> box = node.source[i] == no_leaf ? empty_box<T>() : nodes[node.source[i]].box;
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    node.low[axis][i] = box.low[axis];
                    node.high[axis][i] = box.high[axis];
                }
            }
    }

private:
    /// Makes the wide node of a binary node. Beginning with its two children, the one with the most nodes below it is
    /// replaced by its own two children until there are eight.
    void add(std::span<const TreeNode<T>> nodes, std::uint32_t root, std::vector<std::uint32_t>& roots) {
        std::array<std::uint32_t, Node::width> members;
        std::size_t count = 1;
        members[0] = root;
        const auto size = [&](std::uint32_t i) { return nodes[i].skip - i; };
        while (count < Node::width) {
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
        for (std::size_t i = 0; i < Node::width; ++i) {
            node.source[i] = i < count ? members[i] : no_leaf;
            if (i >= count)
                continue;
            const std::uint32_t leaf = nodes[members[i]].leaf;
            node.child[i] = leaf != no_leaf ? leaf | Node::leaf_flag : std::uint32_t(roots.size());
            if (leaf == no_leaf)
                roots.push_back(members[i]);
        }
        nodes_.push_back(node);
    }

    std::vector<Node> nodes_;
};

} // namespace nephroid::detail
