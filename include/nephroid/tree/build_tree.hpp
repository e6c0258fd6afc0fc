// SPDX-License-Identifier: MIT
/// @file  Building a kd-tree: nanoflann divides the points into thousands, and these are divided on in contiguous
///        memory.
#pragma once

#include "nephroid/tree/tree_node.hpp"

#include <nanoflann.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

namespace nephroid::detail {

/// Points as nanoflann asks for them.
template <Scalar T>
struct PointCloud {
    std::vector<std::array<T, 3>> points;
    [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
    [[nodiscard]] T kdtree_get_pt(std::size_t i, std::size_t axis) const { return points[i][axis]; }
    template <class Bounds>
    bool kdtree_get_bbox(Bounds&) const {
        return false;
    }
};

/// A tree's nodes, and its points in leaf order.
///
/// nanoflann reads points where they lie, through a permutation: fast while there are few nodes, and slow for the many
/// at the bottom. From `coarse_size` points on they are copied out and divided here, across the longest side of the
/// box that is tight about them, into leaves that are as full as can be.
template <Scalar T>
class TreeBuilder {
public:
    /// @param cloud      not empty, finite
    /// @param leaf_size  points in a leaf at most
    /// @param lanes      leaves start at multiples of this many slots, and are filled up by repeating their last point
    TreeBuilder(const PointCloud<T>& cloud, std::size_t leaf_size, std::size_t lanes)
        : leaf_size_(leaf_size), lanes_(lanes) {
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

    /// A point. Its index rides along as a fourth coordinate, so that one is moved and compared as a vector of four.
    struct Point {
        std::array<T, 4> at;

        Point(const std::array<T, 3>& place, std::uint32_t index) : at{place[0], place[1], place[2], packed(index)} {}
        [[nodiscard]] std::uint32_t index() const {
            if constexpr (std::is_same_v<T, float>)
                return std::bit_cast<std::uint32_t>(at[3]);
            else
                return static_cast<std::uint32_t>(static_cast<double>(at[3]));
        }

    private:
        [[nodiscard]] static T packed(std::uint32_t index) {
            if constexpr (std::is_same_v<T, float>)
                return std::bit_cast<float>(index);
            else
                return T(index);
        }
    };

    static constexpr std::size_t coarse_size = 16384;
    static constexpr std::size_t none = (std::numeric_limits<std::size_t>::max)();
    static constexpr T infinity = std::numeric_limits<T>::infinity();

    /// Depth-first with a stack of its own: clustered points make trees deeper than a call stack should be.
    template <class Order, class Node>
    void lay_out(const PointCloud<T>& cloud, const Order& order, const Node* root) {
        struct Pending {
            const Node* node;       ///< nanoflann's, or none:
            std::size_t begin, end; ///< these points
            std::size_t parent;
        };
        std::vector<Pending> pending{{root, 0, 0, none}};
        while (!pending.empty()) {
            auto [node, begin, end, parent] = pending.back();
            pending.pop_back();
            const std::size_t self = nodes.size();
            nodes.push_back({{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}}, 0, no_leaf});
            parents_.push_back(parent);
            if (node != nullptr && node->child1 != nullptr) {
                pending.push_back({node->child2, 0, 0, self});
                pending.push_back({node->child1, 0, 0, self});
                continue;
            }
            if (node != nullptr) {
                points_.clear();
                for (std::size_t i = node->node_type.lr.left; i < node->node_type.lr.right; ++i)
                    points_.push_back({cloud.points[order[i]], std::uint32_t(order[i])});
                end = points_.size();
            }
            const Box<T> box = bounds(begin, end);
            nodes[self].box = box;
            if (end - begin <= leaf_size_) {
                nodes[self].leaf = std::uint32_t(leaves.size());
                append_leaf(begin, end);
                continue;
            }
            const std::size_t middle = halve(begin, end, box);
            pending.push_back({nullptr, middle, end, self});
            pending.push_back({nullptr, begin, middle, self});
        }
    }

    [[nodiscard]] Box<T> bounds(std::size_t begin, std::size_t end) const {
        std::array<T, 4> low = points_[begin].at, high = low; // the fourth of no meaning
        const Point* const points = points_.data();
        for (std::size_t i = begin + 1; i < end; ++i)
#pragma GCC unroll 1 // else GCC unrolls it, and then does not vectorise it
            for (std::size_t axis = 0; axis < 4; ++axis) {
                const T x = points[i].at[axis];
                low[axis] = x < low[axis] ? x : low[axis];
                high[axis] = high[axis] < x ? x : high[axis];
            }
        return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
    }

    /// Puts those of the lower half first, across the longest side; returns where the others begin. Many are parted in
    /// the middle; the last few hundred where all leaves below will be as full as can be.
    [[nodiscard]] std::size_t halve(std::size_t begin, std::size_t end, const Box<T>& box) {
        std::size_t axis = 0;
        for (std::size_t other = 1; other < 3; ++other)
            if (box.high[other] - box.low[other] > box.high[axis] - box.low[axis])
                axis = other;
        const std::size_t size = end - begin, leaf_count = (size + leaf_size_ - 1) / leaf_size_;
        if (leaf_count > 12) {
            const std::size_t border = partition(axis, begin, end, T(0.5) * box.low[axis] + T(0.5) * box.high[axis]);
            if (border != begin && border != end)
                return border;
        }
        const std::size_t middle = begin + size * (leaf_count / 2) / leaf_count;
        select(axis, begin, end, middle, box.low[axis], box.high[axis]);
        return middle;
    }

    /// Orders points as std::nth_element does. By interpolation, as most are spread evenly: one pass over all of them
    /// then leaves few to look at. Without a branch for each point, which would go either way.
    ///
    /// @param low, high  of the coordinate
    void select(std::size_t axis, std::size_t begin, std::size_t end, std::size_t middle, T low, T high) {
        constexpr std::size_t few = 32;
        for (int tries = 0; tries < 8 && end - begin > few; ++tries) {
            const T share = T(middle - begin) / T(end - begin), guess = (T(1) - share) * low + share * high;
            const std::size_t border = partition(axis, begin, end, guess);
            if (border == middle)
                return;
            (middle < border ? end : begin) = border;
            (middle < border ? high : low) = guess;
        }
        std::nth_element(points_.begin() + std::ptrdiff_t(begin), points_.begin() + std::ptrdiff_t(middle),
                         points_.begin() + std::ptrdiff_t(end),
                         [axis](const Point& a, const Point& b) { return a.at[axis] < b.at[axis]; });
    }

    /// Puts the points below a border first; returns where the others begin.
    [[nodiscard]] std::size_t partition(std::size_t axis, std::size_t begin, std::size_t end, T border) {
        Point* const points = points_.data();
        above_.resize(points_.size(), points[begin]);
        Point* const others = above_.data();
        std::size_t below = begin, above = 0;
        for (std::size_t i = begin; i < end; ++i) {
            const Point point = points[i];
            const bool is_below = point.at[axis] < border;
            points[below] = others[above] = point;
            below += std::size_t(is_below);
            above += std::size_t(!is_below);
        }
        std::copy_n(others, above, points + below);
        return below;
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

    /// Children follow their parents: one pass backwards makes the upper boxes and the skips.
    void skip_and_bound() {
        for (std::size_t i = nodes.size(); i-- > 0;) {
            nodes[i].skip = (std::max)(nodes[i].skip, std::uint32_t(i + 1));
            if (parents_[i] == none)
                continue;
            TreeNode<T>& parent = nodes[parents_[i]];
            parent.skip = (std::max)(parent.skip, nodes[i].skip);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                parent.box.low[axis] = (std::min)(parent.box.low[axis], nodes[i].box.low[axis]);
                parent.box.high[axis] = (std::max)(parent.box.high[axis], nodes[i].box.high[axis]);
            }
        }
    }

    std::size_t leaf_size_, lanes_;
    std::vector<Point> points_, above_;
    std::vector<std::size_t> parents_;
};

} // namespace nephroid::detail
