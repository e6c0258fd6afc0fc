// SPDX-License-Identifier: MIT
/// @file  A spatial look-up over points: nanoflann builds the tree, the library lays it out and walks it.
///
/// The points are put in the tree's leaf order once, relative to an origin amid them, as one array per coordinate:
/// a leaf is a contiguous range that a compiler can vectorise over, and a scene far from its origin keeps the digits
/// of small distances.
#pragma once

#include "nephroid/vector/algebra.hpp"
#include "nephroid/vector/error.hpp"
#include "nephroid/vector/text.hpp"

#include <nanoflann.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

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

/// A point found by `PointTree::nearest`.
template <Scalar T>
struct Neighbour {
    T distance2;        ///< to the place asked for, world units squared
    std::uint32_t slot; ///< in the tree's leaf order
};

/// Slots [first, first + size) of the leaf order hold points; up to the next multiple of `PointTree::lanes` they
/// repeat the last one, so that loops over whole lanes read nothing foreign.
struct TreeLeaf {
    std::uint32_t first;
    std::uint32_t size;
};

template <Vector3 V>
class PointTree {
public:
    using T = scalar_t<V>;
    static constexpr std::size_t lanes = 16;     ///< leaves start at multiples of this many slots
    static constexpr std::size_t leaf_size = 64; ///< points in a leaf at most

    /// @param count      number of points
    /// @param position   position(i) -> V for i in 0 … count − 1; every one must be finite
    /// @param who        the caller's name for error messages
    template <class Position>
    PointTree(std::size_t count, Position&& position, const char* who = "nephroid::PointTree") {
        if (count >= no_leaf / 2)
            invalid_argument(std::string(who) + ": " + std::to_string(count) + " points are more than 2^31");
        Cloud cloud = gather(count, position, who);
        if (count > 0)
            lay_out(cloud);
    }

    [[nodiscard]] bool empty() const { return nodes_.empty(); }
    [[nodiscard]] const V& origin() const { return origin_; }
    /// About all points, relative to the origin; low > high when there are none.
    [[nodiscard]] const Box<T>& bounds() const { return bounds_; }
    [[nodiscard]] std::span<const TreeNode<T>> nodes() const { return nodes_; }
    [[nodiscard]] std::span<const TreeLeaf> leaves() const { return leaves_; }
    /// Number of slots of the leaf order, repeated ones included.
    [[nodiscard]] std::size_t slots() const { return index_.size(); }
    /// The point in a slot: its index as the user counts.
    [[nodiscard]] std::uint32_t index(std::size_t slot) const { return index_[slot]; }
    /// Coordinates by slot, relative to the origin.
    [[nodiscard]] const T* x() const { return coordinates_[0].data(); }
    [[nodiscard]] const T* y() const { return coordinates_[1].data(); }
    [[nodiscard]] const T* z() const { return coordinates_[2].data(); }

    /// A world position relative to the origin.
    [[nodiscard]] V relative(const V& position) const { return position - origin_; }

    /// Calls visit(leaf) for every leaf whose box overlaps this one, in leaf order.
    template <class Visit>
    void visit_leaves(const Box<T>& box, Visit&& visit) const {
        for (std::size_t i = 0; i < nodes_.size();) {
            const TreeNode<T>& node = nodes_[i];
            if (!node.box.overlaps(box)) {
                i = node.skip;
                continue;
            }
            if (node.leaf != no_leaf)
                visit(node.leaf);
            ++i;
        }
    }

    /// The leaf whose box is nearest to a point (relative to the origin), by the boxes' Chebyshev distance; the tree
    /// must not be empty.
    [[nodiscard]] std::uint32_t nearest_leaf(const V& relative_position) const {
        using t = vector_traits<V>;
        const std::array<T, 3> p = {t::x(relative_position), t::y(relative_position), t::z(relative_position)};
        const auto distance_to = [&](const TreeNode<T>& node) {
            T distance(0);
            for (std::size_t axis = 0; axis < 3; ++axis)
                distance = (std::max)({distance, node.box.low[axis] - p[axis], p[axis] - node.box.high[axis]});
            return distance;
        };

        // Down to a near leaf first: most points lie in it, and for the others it leaves little to search.
        const std::size_t start = descend(distance_to);
        std::uint32_t found = nodes_[start].leaf;
        T best = distance_to(nodes_[start]);
        for (std::size_t i = 0; i < nodes_.size();) {
            const TreeNode<T>& node = nodes_[i];
            const T distance = distance_to(node);
            if (!(distance < best)) {
                i = node.skip;
                continue;
            }
            if (node.leaf != no_leaf) {
                best = distance;
                found = node.leaf;
            }
            ++i;
        }
        return found;
    }

    /// The points nearest to a place (relative to the origin), in no particular order.
    ///
    /// @param found  room for as many as are wanted; a heap, so that the farthest is replaced first
    /// @return  how many there are: found.size(), or all points if there are fewer
    std::size_t nearest(const V& relative_position, std::span<Neighbour<T>> found) const {
        using t = vector_traits<V>;
        if (empty() || found.empty())
            return 0;
        const std::array<T, 3> p = {t::x(relative_position), t::y(relative_position), t::z(relative_position)};
        const auto distance2_to = [&](const TreeNode<T>& node) {
            T distance2(0);
            for (std::size_t axis = 0; axis < 3; ++axis)
                distance2 = distance2 + square((std::max)({T(0), node.box.low[axis] - p[axis],
                                                           p[axis] - node.box.high[axis]}));
            return distance2;
        };
        const auto nearer = [](const Neighbour<T>& a, const Neighbour<T>& b) { return a.distance2 < b.distance2; };
        std::size_t count = 0;
        const auto take_from = [&](const TreeLeaf& leaf) {
            for (std::uint32_t slot = leaf.first; slot < leaf.first + leaf.size; ++slot) {
                const T distance2 = square(x()[slot] - p[0]) + square(y()[slot] - p[1]) + square(z()[slot] - p[2]);
                if (count < found.size()) {
                    found[count++] = {distance2, slot};
                    std::push_heap(found.begin(), found.begin() + std::ptrdiff_t(count), nearer);
                } else if (distance2 < found.front().distance2) {
                    std::pop_heap(found.begin(), found.end(), nearer);
                    found.back() = {distance2, slot};
                    std::push_heap(found.begin(), found.end(), nearer);
                }
            }
        };

        const std::uint32_t start = nodes_[descend(distance2_to)].leaf;
        take_from(leaves_[start]);
        for (std::size_t i = 0; i < nodes_.size();) {
            const TreeNode<T>& node = nodes_[i];
            if (count == found.size() && !(distance2_to(node) < found.front().distance2)) {
                i = node.skip;
                continue;
            }
            if (node.leaf != no_leaf && node.leaf != start)
                take_from(leaves_[node.leaf]);
            ++i;
        }
        return count;
    }

private:
    /// The points as nanoflann asks for them.
    struct Cloud {
        std::vector<std::array<T, 3>> points;
        [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
        [[nodiscard]] T kdtree_get_pt(std::size_t i, std::size_t axis) const { return points[i][axis]; }
        template <class Bounds>
        bool kdtree_get_bbox(Bounds&) const {
            return false;
        }
    };
    using Index = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<T, Cloud>, Cloud, 3, std::uint32_t>;

    /// The node of a leaf that lies near, by always taking the nearer child.
    template <class Distance>
    [[nodiscard]] std::size_t descend(const Distance& distance_to) const {
        std::size_t node = 0;
        while (nodes_[node].leaf == no_leaf) {
            const std::size_t first = node + 1, second = nodes_[first].skip;
            node = distance_to(nodes_[first]) <= distance_to(nodes_[second]) ? first : second;
        }
        return node;
    }

    template <class Position>
    [[nodiscard]] Cloud gather(std::size_t count, Position&& position, const char* who) {
        using t = vector_traits<V>;
        Cloud cloud;
        cloud.points.reserve(count);
        std::array<T, 3> low, high;
        low.fill(std::numeric_limits<T>::infinity());
        high.fill(-std::numeric_limits<T>::infinity());
        for (std::size_t i = 0; i < count; ++i) {
            const V p = position(i);
            if (!all_finite(p))
                invalid_argument(std::string(who) + ": point " + std::to_string(i) + " is at " + detail::text_of(p) +
                                 "; every position must be finite");
            cloud.points.push_back({t::x(p), t::y(p), t::z(p)});
            for (std::size_t axis = 0; axis < 3; ++axis) {
                low[axis] = (std::min)(low[axis], cloud.points.back()[axis]);
                high[axis] = (std::max)(high[axis], cloud.points.back()[axis]);
            }
        }
        if (count > 0) {
            std::array<T, 3> origin;
            for (std::size_t axis = 0; axis < 3; ++axis)
                origin[axis] = T(0.5) * low[axis] + T(0.5) * high[axis];
            origin_ = t::make(origin[0], origin[1], origin[2]);
            for (auto& p : cloud.points)
                for (std::size_t axis = 0; axis < 3; ++axis)
                    p[axis] = p[axis] - origin[axis];
        }
        return cloud;
    }

    void lay_out(const Cloud& cloud) {
        const Index tree(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(leaf_size));
        // nanoflann 1.5 renamed the members that hold the tree.
        if constexpr (requires { tree.vAcc_; })
            lay_out(cloud, tree.vAcc_, tree.root_node_);
        else
            lay_out(cloud, tree.vAcc, tree.root_node);
        bounds_ = nodes_.front().box;
    }

    template <class Order, class Node>
    void lay_out(const Cloud& cloud, const Order& order, const Node* root) {
        // Depth-first with a stack of its own: clustered points make trees deeper than a call stack should be.
        struct Pending {
            const Node* node;
            std::size_t parent;
        };
        constexpr std::size_t none = (std::numeric_limits<std::size_t>::max)();
        std::vector<Pending> pending{{root, none}};
        std::vector<std::size_t> parents;
        while (!pending.empty()) {
            const auto [node, parent] = pending.back();
            pending.pop_back();
            const std::size_t self = nodes_.size();
            nodes_.push_back({{}, 0, no_leaf});
            parents.push_back(parent);
            if (node->child1 == nullptr) {
                nodes_[self].leaf = std::uint32_t(leaves_.size());
                append_leaf(cloud, order, node->node_type.lr.left, node->node_type.lr.right, nodes_[self].box);
            } else {
                pending.push_back({node->child2, self});
                pending.push_back({node->child1, self});
            }
        }
        // Children follow their parents: one pass backwards makes the inner boxes and the skips.
        for (TreeNode<T>& node : nodes_)
            if (node.leaf == no_leaf)
                node.box = {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
        for (std::size_t i = nodes_.size(); i-- > 0;) {
            nodes_[i].skip = (std::max)(nodes_[i].skip, std::uint32_t(i + 1));
            if (parents[i] == none)
                continue;
            TreeNode<T>& parent = nodes_[parents[i]];
            parent.skip = (std::max)(parent.skip, nodes_[i].skip);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                parent.box.low[axis] = (std::min)(parent.box.low[axis], nodes_[i].box.low[axis]);
                parent.box.high[axis] = (std::max)(parent.box.high[axis], nodes_[i].box.high[axis]);
            }
        }
    }

    template <class Order>
    void append_leaf(const Cloud& cloud, const Order& order, std::size_t from, std::size_t to, Box<T>& box) {
        box = {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
        leaves_.push_back({std::uint32_t(index_.size()), std::uint32_t(to - from)});
        const auto append = [&](std::uint32_t i) {
            index_.push_back(i);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const T coordinate = cloud.points[i][axis];
                coordinates_[axis].push_back(coordinate);
                box.low[axis] = (std::min)(box.low[axis], coordinate);
                box.high[axis] = (std::max)(box.high[axis], coordinate);
            }
        };
        for (std::size_t slot = from; slot < to; ++slot)
            append(std::uint32_t(order[slot]));
        while (index_.size() % lanes != 0)
            append(std::uint32_t(order[to - 1]));
    }

    static constexpr T infinity = std::numeric_limits<T>::infinity();

    V origin_ = zero_vector<V>();
    Box<T> bounds_{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
    std::vector<TreeNode<T>> nodes_;
    std::vector<TreeLeaf> leaves_;
    std::vector<std::uint32_t> index_;
    std::array<std::vector<T>, 3> coordinates_;
};

} // namespace nephroid
