// SPDX-License-Identifier: MIT
/// @file  A kd-tree over points. nanoflann divides the upper levels; the library builds the rest, stores and searches
///        it.
///
/// The points are stored in the tree's leaf order, relative to an origin in their middle, with one array per
/// coordinate. So a leaf is a contiguous range over which compilers can vectorise, and a scene far from its origin
/// keeps the digits of small distances.
#pragma once

#include "nephroid/execution/executor.hpp"
#include "nephroid/tree/build_tree.hpp"
#include "nephroid/tree/point_tree_view.hpp"
#include "nephroid/tree/wide_tree.hpp"

#include <string>
#include <utility>
#include <vector>

namespace nephroid {

/// Owns a tree over points. PointTreeView documents the look-ups.
template <Vector3 V>
class PointTree {
public:
    using T = scalar_t<V>;
    using View = PointTreeView<V>;
    static constexpr std::size_t lanes = View::lanes;
    static constexpr std::size_t leaf_size = View::leaf_size;

    /// @param count      number of points
    /// @param position   position(i) -> V for i in 0 … count − 1; every one must be finite
    /// @param who        the caller's name for error messages
    template <class Position>
    PointTree(std::size_t count, Position&& position, const char* who = "nephroid::PointTree") {
        if (count >= no_leaf / 2)
            invalid_argument(std::string(who) + ": " + std::to_string(count) + " points are more than 2^31");
        detail::PointCloud<T> cloud = detail::gather_points<V>(count, position, who);
        origin_ = detail::centre_on_median(cloud);
        if (count == 0)
            return;
        detail::TreeBuilder<T> built(cloud, leaf_size, lanes);
        nodes_ = std::move(built.nodes);
        leaves_ = std::move(built.leaves);
        index_ = std::move(built.index);
        coordinates_ = std::move(built.coordinates);
        wide_ = detail::WideTree<T>(nodes());
    }

    /// A view of the tree, valid as long as the tree lives and its points are not moved.
    [[nodiscard]] View view() const {
        return View({origin_,
                     nodes(),
                     wide_.nodes(),
                     leaves(),
                     {index_.data(), index_.size()},
                     {coordinates_[0].data(), coordinates_[1].data(), coordinates_[2].data()}});
    }

    // See PointTreeView.
    [[nodiscard]] bool empty() const { return nodes_.empty(); }
    [[nodiscard]] V origin() const { return view().origin(); }
    [[nodiscard]] Box<T> bounds() const { return view().bounds(); }
    [[nodiscard]] std::span<const TreeNode<T>> nodes() const { return {nodes_.data(), nodes_.size()}; }
    [[nodiscard]] std::span<const TreeLeaf> leaves() const { return {leaves_.data(), leaves_.size()}; }
    [[nodiscard]] std::size_t slots() const { return index_.size(); }
    [[nodiscard]] std::uint32_t index(std::size_t slot) const { return index_[slot]; }
    [[nodiscard]] const T* x() const { return coordinates_[0].data(); }
    [[nodiscard]] const T* y() const { return coordinates_[1].data(); }
    [[nodiscard]] const T* z() const { return coordinates_[2].data(); }
    [[nodiscard]] V relative(const V& position) const { return view().relative(position); }
    template <class Q, class Visit>
    void visit_leaves(const Q& volume, Visit&& visit) const {
        view().visit_leaves(volume, visit);
    }
    [[nodiscard]] std::uint32_t nearest_leaf(const V& relative_position) const {
        return view().nearest_leaf(relative_position);
    }
    void distances2(std::size_t slot, const std::array<T, 3>& position, std::array<T, lanes>& distance2) const {
        view().distances2(slot, position, distance2);
    }
    template <class Accept = AcceptAll>
    std::size_t nearest(const V& relative_position, std::span<Neighbour<T>> found,
                        T limit2 = std::numeric_limits<T>::infinity(), const Accept& accept = {}) const {
        return view().nearest(relative_position, found, limit2, accept);
    }

    /// Moves the points without changing the tree's structure: every slot keeps its point, and the boxes are fitted to
    /// the new positions. Look-ups stay exact however far points moved, but slow down when leaves begin to overlap.
    ///
    /// @param moved  finite coordinates by slot, relative to the origin: slots() for each axis, of which those that
    ///               repeat a point are not read. Contains the old coordinates afterwards
    template <class E>
        requires Executor<E&>
    void refit(std::array<std::vector<T>, 3>& moved, E& executor) {
        coordinates_.swap(moved);
        constexpr std::size_t nodes_per_task = 64;
        detail::for_each_index(executor, nodes_.size(), nodes_per_task, [&](std::size_t i) {
            if (nodes_[i].leaf != no_leaf)
                refit_leaf(leaves_[nodes_[i].leaf], nodes_[i].box);
        });
        detail::gather_upwards<T>(nodes(), [&](std::size_t node, std::size_t child) {
            if (child == node + 1)
                nodes_[node].box = nodes_[child].box;
            else
                nodes_[node].box.add(nodes_[child].box);
        });
        wide_.refit(nodes());
    }

private:
    /// Pads a leaf to whole lanes with its last point, and computes its box.
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

    std::array<T, 3> origin_;
    std::vector<TreeNode<T>> nodes_;
    detail::WideTree<T> wide_;
    std::vector<TreeLeaf> leaves_;
    std::vector<std::uint32_t> index_;
    std::array<std::vector<T>, 3> coordinates_;
};

} // namespace nephroid
