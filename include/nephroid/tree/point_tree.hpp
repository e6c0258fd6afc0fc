// SPDX-License-Identifier: MIT
/// @file  A spatial look-up over points: nanoflann builds the tree, the library lays it out and walks it.
///
/// The points are put in the tree's leaf order once, relative to an origin amid them, as one array per coordinate:
/// a leaf is a contiguous range that a compiler can vectorise over, and a scene far from its origin keeps the digits
/// of small distances.
#pragma once

#include "nephroid/execution/executor.hpp"
#include "nephroid/tree/build_tree.hpp"
#include "nephroid/tree/nearest_points.hpp"
#include "nephroid/tree/tree_node.hpp"
#include "nephroid/tree/wide_tree.hpp"
#include "nephroid/vector/algebra.hpp"
#include "nephroid/vector/error.hpp"
#include "nephroid/vector/text.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace nephroid {

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
        const detail::PointCloud<T> cloud = gather(count, position, who);
        if (count == 0)
            return;
        detail::TreeBuilder<T> built(cloud, leaf_size, lanes);
        nodes_ = std::move(built.nodes);
        leaves_ = std::move(built.leaves);
        index_ = std::move(built.index);
        coordinates_ = std::move(built.coordinates);
        bounds_ = nodes_.front().box;
        wide_ = detail::WideTree<T>(nodes_);
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

    /// Moves the points and keeps the tree's shape: every slot keeps its point, and the boxes are drawn tight about
    /// where the points are now. Look-ups stay exact however far they moved, and slow down as leaves come to overlap.
    ///
    /// @param moved  coordinates by slot, relative to the origin, finite; slots() for each axis, of which those that
    ///               repeat a point are not read. Holds the coordinates from before afterwards.
    template <class E>
        requires Executor<E&>
    void refit(std::array<std::vector<T>, 3>& moved, E& executor) {
        coordinates_.swap(moved);
        constexpr std::size_t nodes_per_task = 64;
        detail::for_each_index(executor, nodes_.size(), nodes_per_task, [&](std::size_t i) {
            if (nodes_[i].leaf != no_leaf)
                refit_leaf(leaves_[nodes_[i].leaf], nodes_[i].box);
        });
        for (std::size_t i = nodes_.size(); i-- > 0;) { // children follow their parents
            if (nodes_[i].leaf != no_leaf)
                continue;
            const Box<T>&first = nodes_[i + 1].box, &second = nodes_[nodes_[i + 1].skip].box;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                nodes_[i].box.low[axis] = (std::min)(first.low[axis], second.low[axis]);
                nodes_[i].box.high[axis] = (std::max)(first.high[axis], second.high[axis]);
            }
        }
        if (!nodes_.empty())
            bounds_ = nodes_.front().box;
        wide_.refit(nodes_);
    }

    /// Calls visit(leaf) for every leaf whose box overlaps this one, in leaf order.
    template <class Visit>
    void visit_leaves(const Box<T>& box, Visit&& visit) const {
        wide_.visit_leaves(nodes_, box, visit);
    }

    /// The leaf whose box is nearest to a point (relative to the origin), by the boxes' Chebyshev distance; the tree
    /// must not be empty.
    [[nodiscard]] std::uint32_t nearest_leaf(const V& relative_position) const {
        using t = vector_traits<V>;
        const std::array<T, 3> p = {t::x(relative_position), t::y(relative_position), t::z(relative_position)};
        return wide_.nearest_leaf(nodes_, p);
    }

    /// Squared distances from a place (relative to the origin) to the points in `lanes` slots from this one on.
    void distances2(std::size_t slot, const std::array<T, 3>& place, std::array<T, lanes>& distance2) const {
        const T* const px = x() + slot;
        const T* const py = y() + slot;
        const T* const pz = z() + slot;
        const T cx = place[0], cy = place[1], cz = place[2];
#pragma GCC unroll 1 // else GCC unrolls it, and then does not vectorise it
        for (std::size_t i = 0; i < lanes; ++i)
            distance2[i] = square(px[i] - cx) + square(py[i] - cy) + square(pz[i] - cz);
    }

    /// The points nearest to a place (relative to the origin), in no particular order. None to a place that is no
    /// number.
    ///
    /// @param found   room for as many as are wanted
    /// @param limit2  only points nearer than the root of this count
    /// @param accept  accept(slot): whether a point counts at all; asked of points that lie near enough, and of their
    ///                neighbours in the leaf order, so that it can be vectorised; must not look up nearest points
    ///                itself
    /// @return  how many there are: found.size(), or all that count if there are fewer
    template <class Accept = AcceptAll>
    std::size_t nearest(const V& relative_position, std::span<Neighbour<T>> found,
                        T limit2 = std::numeric_limits<T>::infinity(), const Accept& accept = {}) const {
        using t = vector_traits<V>;
        const std::array<T, 3> p = {t::x(relative_position), t::y(relative_position), t::z(relative_position)};
        if (empty() || found.empty() || !(p[0] == p[0] && p[1] == p[1] && p[2] == p[2]))
            return 0;
        detail::NearestPoints<T> nearest(found.size(), limit2, lanes);
        // The nearer child first; the other one waits here. A tree too deep for that (points clustered over hundreds of
        // orders of two) has the rest of a branch walked in the nodes' own order, which needs no room.
        struct Waiting {
            T distance2;
            std::uint32_t node;
        };
        constexpr std::size_t most_waiting = 64;
        std::array<Waiting, most_waiting> waiting;
        std::size_t top = 0;
        T distance2 = distance2_to(nodes_.front(), p);
        for (std::uint32_t node = 0;;) {
            if (nearest.wants(distance2)) {
                if (nodes_[node].leaf != no_leaf) {
                    take_leaf(leaves_[nodes_[node].leaf], p, nearest, accept);
                } else if (top == most_waiting) {
                    take_subtree(node, p, nearest, accept);
                } else {
                    const std::uint32_t first = node + 1, second = nodes_[first].skip;
                    const T to_first = distance2_to(nodes_[first], p), to_second = distance2_to(nodes_[second], p);
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
        return nearest.put(found);
    }

private:
    [[nodiscard]] static T distance2_to(const TreeNode<T>& node, const std::array<T, 3>& p) {
        const auto larger = [](const T& a, const T& b) { return a > b ? a : b; };
        const auto beside = [&](std::size_t axis) {
            return larger(larger(node.box.low[axis] - p[axis], p[axis] - node.box.high[axis]), T(0));
        };
        return square(beside(0)) + square(beside(1)) + square(beside(2));
    }

    template <class Accept>
    void take_leaf(const TreeLeaf& leaf, const std::array<T, 3>& p, detail::NearestPoints<T>& nearest,
                   const Accept& accept) const {
        for (std::uint32_t first = 0; first < leaf.size; first += lanes) {
            std::array<T, lanes> distance2;
            distances2(leaf.first + first, p, distance2);
            const std::size_t size = (std::min)(lanes, std::size_t(leaf.size - first));
            nearest.offer(distance2, size, leaf.first + first, accept);
        }
    }

    template <class Accept>
    void take_subtree(std::uint32_t root, const std::array<T, 3>& p, detail::NearestPoints<T>& nearest,
                      const Accept& accept) const {
        for (std::uint32_t i = root; i < nodes_[root].skip;) {
            const TreeNode<T>& node = nodes_[i];
            if (!nearest.wants(distance2_to(node, p))) {
                i = node.skip;
                continue;
            }
            if (node.leaf != no_leaf)
                take_leaf(leaves_[node.leaf], p, nearest, accept);
            ++i;
        }
    }

    /// Repeats a leaf's last point up to whole lanes, and draws its box.
    void refit_leaf(const TreeLeaf& leaf, Box<T>& box) {
        const std::size_t last = leaf.first + leaf.size - 1;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            T* const coordinate = coordinates_[axis].data();
            for (std::size_t slot = last + 1; slot % lanes != 0; ++slot)
                coordinate[slot] = coordinate[last];
            const auto [low, high] = std::minmax_element(coordinate + leaf.first, coordinate + last + 1);
            box.low[axis] = *low, box.high[axis] = *high;
        }
    }

    template <class Position>
    [[nodiscard]] detail::PointCloud<T> gather(std::size_t count, Position&& position, const char* who) {
        using t = vector_traits<V>;
        detail::PointCloud<T> cloud;
        cloud.points.reserve(count);
        for (std::size_t i = 0; i < count; ++i) {
            const V p = position(i);
            if (!all_finite(p))
                invalid_argument(std::string(who) + ": point " + std::to_string(i) + " is at " + detail::text_of(p) +
                                 "; every position must be finite");
            cloud.points.push_back({t::x(p), t::y(p), t::z(p)});
        }
        if (count > 0) {
            const std::array<T, 3> origin = middle_of(cloud.points);
            origin_ = t::make(origin[0], origin[1], origin[2]);
            for (auto& p : cloud.points)
                for (std::size_t axis = 0; axis < 3; ++axis)
                    p[axis] = p[axis] - origin[axis];
        }
        return cloud;
    }

    /// The median of each coordinate, of a few thousand of the points: a stray one far away must not take the digits of
    /// all others, as it would with the middle of the bounds.
    [[nodiscard]] static std::array<T, 3> middle_of(const std::vector<std::array<T, 3>>& points) {
        const std::size_t stride = (points.size() + 4095) / 4096;
        std::array<T, 3> middle;
        std::vector<T> along;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            along.clear();
            for (std::size_t i = 0; i < points.size(); i += stride)
                along.push_back(points[i][axis]);
            const auto half = along.begin() + std::ptrdiff_t(along.size() / 2);
            std::nth_element(along.begin(), half, along.end());
            middle[axis] = *half;
        }
        return middle;
    }

    static constexpr T infinity = std::numeric_limits<T>::infinity();

    V origin_ = zero_vector<V>();
    Box<T> bounds_{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
    std::vector<TreeNode<T>> nodes_;
    detail::WideTree<T> wide_;
    std::vector<TreeLeaf> leaves_;
    std::vector<std::uint32_t> index_;
    std::array<std::vector<T>, 3> coordinates_;
};

} // namespace nephroid
