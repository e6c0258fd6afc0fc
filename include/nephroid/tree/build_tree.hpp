// SPDX-License-Identifier: MIT
/// @file  Builds a kd-tree: nanoflann divides the points down to thousands, and these are divided further in contiguous
///        memory.
#pragma once

#include "nephroid/tree/divided_points.hpp"
#include "nephroid/tree/point_cloud.hpp"
#include "nephroid/tree/tree_node.hpp"

#include <nanoflann.hpp>

namespace nephroid::detail {

/// A tree's nodes, and its points in leaf order.
///
/// nanoflann accesses points through a permutation, which is fast for the few upper nodes and slow for the many at the
/// bottom. So nodes of `coarse_size` points and fewer are copied and divided here (DividedPoints), into leaves that are
/// as full as possible.
template <Scalar T>
class TreeBuilder {
public:
    /// @param cloud      not empty, finite
    /// @param leaf_size  largest number of points in a leaf
    /// @param lanes      leaves start at multiples of this many slots; they are padded by repeating their last point
    TreeBuilder(const PointCloud<T>& cloud, std::size_t leaf_size, std::size_t lanes)
        : leaf_size_(leaf_size), lanes_(lanes), points_(leaf_size) {
        const Index tree(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(coarse_size));
        const std::size_t slots = cloud.points.size() + cloud.points.size() / 3;
        index.reserve(slots);
        for (auto& coordinate : coordinates)
            coordinate.reserve(slots);
        // nanoflann 1.5 renamed the members that hold the tree.
        if constexpr (requires { tree.vAcc_; })
            lay_out(cloud, tree.vAcc_, tree.root_node_);
        else
            lay_out(cloud, tree.vAcc, tree.root_node);
        skip_and_bound();
    }

    std::vector<TreeNode<T>> nodes;
    std::vector<TreeLeaf> leaves;
    std::vector<std::uint32_t> index; ///< by slot
    std::array<std::vector<T>, 3> coordinates;

private:
    using Index = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<T, PointCloud<T>>, PointCloud<T>, 3,
                                                      std::uint32_t>;

    static constexpr std::size_t coarse_size = 16384;
    static constexpr std::size_t none = (std::numeric_limits<std::size_t>::max)();

    /// Goes depth-first with an explicit stack, because clustered points make trees too deep for recursion.
    template <class Order, class Node>
    void lay_out(const PointCloud<T>& cloud, const Order& order, const Node* root) {
        struct Pending {
            const Node* node;       ///< nanoflann's; null for a range of points
            std::size_t begin, end; ///< the range of points
            std::size_t parent;
        };
        std::vector<Pending> pending{{root, 0, 0, none}};
        while (!pending.empty()) {
            auto [node, begin, end, parent] = pending.back();
            pending.pop_back();
            const std::size_t self = nodes.size();
            nodes.push_back({empty_box<T>(), 0, no_leaf});
            parents_.push_back(parent);
            if (node != nullptr && node->child1 != nullptr) {
                pending.push_back({node->child2, 0, 0, self});
                pending.push_back({node->child1, 0, 0, self});
                continue;
            }
            if (node != nullptr) {
                points_.clear();
                for (std::size_t i = node->node_type.lr.left; i < node->node_type.lr.right; ++i)
                    points_.add(cloud.points[order[i]], std::uint32_t(order[i]));
                end = points_.size();
            }
            const Box<T> box = points_.bounds(begin, end);
            nodes[self].box = box;
            if (end - begin <= leaf_size_) {
                nodes[self].leaf = std::uint32_t(leaves.size());
                append_leaf(begin, end);
                continue;
            }
            const std::size_t middle = points_.halve(begin, end, box);
            pending.push_back({nullptr, middle, end, self});
            pending.push_back({nullptr, begin, middle, self});
        }
    }

    void append_leaf(std::size_t begin, std::size_t end) {
        const std::size_t first = index.size(), size = end - begin, filled = (size + lanes_ - 1) / lanes_ * lanes_;
        leaves.push_back({std::uint32_t(first), std::uint32_t(size)});
        index.resize(first + filled);
        for (std::size_t i = 0; i < filled; ++i)
            index[first + i] = points_[begin + (std::min)(i, size - 1)].index();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            coordinates[axis].resize(first + filled);
            for (std::size_t i = 0; i < filled; ++i)
                coordinates[axis][first + i] = points_[begin + (std::min)(i, size - 1)].at[axis];
        }
    }

    /// Computes the inner nodes' boxes and skips. Children follow their parents, so one pass backwards suffices.
    void skip_and_bound() {
        for (std::size_t i = nodes.size(); i-- > 0;) {
            nodes[i].skip = (std::max)(nodes[i].skip, std::uint32_t(i + 1));
            if (parents_[i] == none)
                continue;
            TreeNode<T>& parent = nodes[parents_[i]];
            parent.skip = (std::max)(parent.skip, nodes[i].skip);
            parent.box.add(nodes[i].box);
        }
    }

    std::size_t leaf_size_, lanes_;
    DividedPoints<T> points_;
    std::vector<std::size_t> parents_;
};

} // namespace nephroid::detail
