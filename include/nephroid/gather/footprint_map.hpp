// SPDX-License-Identifier: MIT
/// @file  The footprint map: finds which of many boxes of very different sizes may hold a point.
#pragma once

#include "nephroid/tree/point_tree.hpp"

#include <cmath>

namespace nephroid::detail {

/// Boxes in kd-trees over their centres; the box of a node encloses all boxes below it. There is a tree for every power
/// of four of the boxes' sizes, so that a few large boxes do not enlarge every leaf.
///
/// The boxes have slots in leaf order, one tree after the other. Leaves start at multiples of `PointTree::lanes` and
/// repeat their last slot up to the next, as in PointTree.
template <Vector3 V>
class FootprintMap {
public:
    using T = scalar_t<V>;
    static constexpr std::size_t lanes = PointTree<V>::lanes;
    static constexpr std::size_t leaf_size = PointTree<V>::leaf_size;

    /// @param count   number of boxes
    /// @param centre  centre(i) -> V, finite, for i in 0 … count − 1
    /// @param box     box(i) -> Box about it, in the same coordinates; finite
    /// @param who     the caller's name for error messages
    template <class Centre, class BoxOf>
    FootprintMap(std::size_t count, Centre&& centre, BoxOf&& box, const char* who = "nephroid::FootprintMap") {
        std::vector<std::vector<std::uint32_t>> levels;
        std::vector<int> exponents;
        for (std::size_t i = 0; i < count; ++i) {
            const int exponent = size_class(i, box(i), who);
            std::size_t level = 0;
            while (level < exponents.size() && exponents[level] != exponent)
                ++level;
            if (level == exponents.size()) {
                exponents.push_back(exponent);
                levels.emplace_back();
            }
            levels[level].push_back(std::uint32_t(i));
        }
        for (const auto& members : levels)
            append(members, centre, box, who);
    }

    [[nodiscard]] bool empty() const { return index_.empty(); }
    /// Number of slots, repeated ones included.
    [[nodiscard]] std::size_t slots() const { return index_.size(); }
    /// The box in a slot: its index as the user counts.
    [[nodiscard]] std::uint32_t index(std::size_t slot) const { return index_[slot]; }

    /// Calls visit(leaf) with the slots [leaf.first, leaf.first + leaf.size) of every leaf whose box holds the point,
    /// its border included. A point that is not finite lies in none.
    template <class Visit>
    void visit_leaves(const V& point, Visit&& visit) const {
        using t = vector_traits<V>;
        const std::array<T, 3> p = {t::x(point), t::y(point), t::z(point)};
        const Box<T> box{p, p};
        for (std::size_t i = 0; i < nodes_.size();) {
            const TreeNode<T>& node = nodes_[i];
            if (!node.box.overlaps(box)) {
                i = node.skip;
                continue;
            }
            if (node.leaf != no_leaf)
                visit(leaves_[node.leaf]);
            ++i;
        }
    }

private:
    /// The exponent of the least power of four above a box's longest side.
    [[nodiscard]] static int size_class(std::size_t i, const Box<T>& box, const char* who) {
        T side(0);
        for (std::size_t axis = 0; axis < 3; ++axis)
            side = (std::max)(side, T(box.high[axis] - box.low[axis]));
        bool finite = isfinite(side);
        for (std::size_t axis = 0; axis < 3; ++axis)
            finite = finite && isfinite(box.low[axis]) && isfinite(box.high[axis]);
        if (!finite)
            invalid_argument(std::string(who) + ": box " + std::to_string(i) + " is not finite; every box must be");
        if (!(side > T(0)))
            return (std::numeric_limits<int>::min)();
        int exponent = 0;
        (void)std::frexp(double(side), &exponent);
        return (exponent - (exponent & 1)) / 2;
    }

    /// Appends a tree of these boxes.
    template <class Centre, class BoxOf>
    void append(const std::vector<std::uint32_t>& members, Centre& centre, BoxOf& box, const char* who) {
        const PointTree<V> tree(
            members.size(), [&](std::size_t i) -> V { return centre(std::size_t(members[i])); }, who);
        const auto first_node = std::uint32_t(nodes_.size()), first_leaf = std::uint32_t(leaves_.size()),
                   first_slot = std::uint32_t(index_.size());
        for (std::size_t slot = 0; slot < tree.slots(); ++slot)
            index_.push_back(members[tree.index(slot)]);
        for (const TreeLeaf& leaf : tree.leaves())
            leaves_.push_back({first_slot + leaf.first, leaf.size});
        for (const TreeNode<T>& node : tree.nodes())
            nodes_.push_back(
                {nothing, first_node + node.skip, node.leaf == no_leaf ? no_leaf : first_leaf + node.leaf});
        // Children follow their parents: going backwards, both are ready before the parent.
        for (std::size_t i = nodes_.size(); i-- > first_node;) {
            TreeNode<T>& node = nodes_[i];
            if (node.leaf == no_leaf) {
                extend(node.box, nodes_[i + 1].box);
                extend(node.box, nodes_[nodes_[i + 1].skip].box);
            } else {
                const TreeLeaf leaf = leaves_[node.leaf];
                for (std::size_t slot = leaf.first; slot < leaf.first + leaf.size; ++slot)
                    extend(node.box, box(std::size_t(index_[slot])));
            }
        }
    }

    static void extend(Box<T>& box, const Box<T>& other) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            box.low[axis] = (std::min)(box.low[axis], other.low[axis]);
            box.high[axis] = (std::max)(box.high[axis], other.high[axis]);
        }
    }

    static constexpr T infinity = std::numeric_limits<T>::infinity();
    static constexpr Box<T> nothing{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};

    std::vector<TreeNode<T>> nodes_;
    std::vector<TreeLeaf> leaves_;
    std::vector<std::uint32_t> index_;
};

} // namespace nephroid::detail
