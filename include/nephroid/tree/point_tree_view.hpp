// SPDX-License-Identifier: MIT
/// @file  A view of a tree over points: only pointers, which can be copied to a device.
#pragma once

#include "nephroid/tree/nearest_leaf.hpp"
#include "nephroid/tree/nearest_search.hpp"
#include "nephroid/tree/volume.hpp"
#include "nephroid/vector/algebra.hpp"
#include "nephroid/vector/not_unrolled.hpp"

namespace nephroid {

/// A tree over points. Trivially copyable. It refers to arrays that a PointTree owns, or to copies of them on a device.
template <Vector3 V>
class PointTreeView {
public:
    using T = scalar_t<V>;
    static constexpr std::size_t lanes = detail::leaf_lanes; ///< leaves start at multiples of this many slots
    static constexpr std::size_t leaf_size = 64;             ///< largest number of points in a leaf

    /// The arrays of the tree: copy them to use the tree on a device.
    struct Arrays {
        std::array<T, 3> origin;
        std::span<const TreeNode<T>> nodes;
        std::span<const detail::WideNode<T>> wide_nodes;
        std::span<const TreeLeaf> leaves;
        std::span<const std::uint32_t> index;
        std::array<const T*, 3> coordinates; ///< as many as indices
    };

    explicit constexpr PointTreeView(const Arrays& arrays) : arrays_(arrays) {}

    [[nodiscard]] constexpr const Arrays& arrays() const { return arrays_; }
    [[nodiscard]] constexpr bool empty() const { return arrays_.nodes.empty(); }
    [[nodiscard]] constexpr V origin() const {
        return make_vector<V>(arrays_.origin[0], arrays_.origin[1], arrays_.origin[2]);
    }
    /// The bounds of all points, relative to the origin; low > high if there are none.
    [[nodiscard]] constexpr Box<T> bounds() const { return empty() ? detail::empty_box<T>() : arrays_.nodes[0].box; }
    [[nodiscard]] constexpr std::span<const TreeNode<T>> nodes() const { return arrays_.nodes; }
    [[nodiscard]] constexpr std::span<const TreeLeaf> leaves() const { return arrays_.leaves; }
    /// The number of slots in the leaf order, including those that repeat a point.
    [[nodiscard]] constexpr std::size_t slots() const { return arrays_.index.size(); }
    /// The index of the point in a slot, as the user counts points.
    [[nodiscard]] constexpr std::uint32_t index(std::size_t slot) const { return arrays_.index[slot]; }
    /// Coordinates by slot, relative to the origin.
    [[nodiscard]] constexpr const T* x() const { return arrays_.coordinates[0]; }
    [[nodiscard]] constexpr const T* y() const { return arrays_.coordinates[1]; }
    [[nodiscard]] constexpr const T* z() const { return arrays_.coordinates[2]; }

    /// A world position relative to the origin.
    [[nodiscard]] constexpr V relative(const V& position) const { return position - origin(); }

    /// Calls visit(leaf) for every leaf whose box the volume overlaps, in leaf order.
    ///
    /// @param volume  relative to the origin
    template <class Q, class Visit>
        requires detail::MustBeVolume<Q, T>
    void visit_leaves(const Q& volume, Visit&& visit) const {
        visit_leaves(
            volume, [](std::uint32_t, const Box<T>&) { return true; }, visit);
    }
    template <class Visit>
    void visit_leaves(const Box<T>& box, Visit&& visit) const {
        detail::visit_overlapping(arrays_.wide_nodes, arrays_.nodes, box, visit);
    }

    /// The same, but skips some nodes and all below them.
    ///
    /// @param enters  enters(node's index, its box) returns whether to enter a node that the volume overlaps
    template <class Q, class Enters, class Visit>
        requires detail::MustBeVolume<Q, T>
    void visit_leaves(const Q& volume, const Enters& enters, Visit&& visit) const {
        const auto both = [&](std::uint32_t node, const Box<T>& box) {
            return bool(volume.overlaps(box)) && bool(enters(node, box));
        };
        detail::visit_entered(arrays_.wide_nodes, arrays_.nodes, both, visit);
    }

    /// The leaf whose box is nearest to a point (relative to the origin), by the boxes' Chebyshev distance; the tree
    /// must not be empty.
    [[nodiscard]] std::uint32_t nearest_leaf(const V& relative_position) const {
        return detail::nearest_leaf(arrays_.wide_nodes, arrays_.nodes, components(relative_position));
    }

    /// Squared distances from a point (relative to the origin) to those in `lanes` slots, beginning with a given one.
    constexpr void distances2(std::size_t slot, const std::array<T, 3>& position,
                              std::array<T, lanes>& distance2) const {
        const T* const px = x() + slot;
        const T* const py = y() + slot;
        const T* const pz = z() + slot;
        const T cx = position[0], cy = position[1], cz = position[2];
        NEPHROID_NOT_UNROLLED
        for (std::size_t i = 0; i < lanes; ++i)
            distance2[i] = square(px[i] - cx) + square(py[i] - cy) + square(pz[i] - cz);
    }

    /// Finds the points nearest to a given one (relative to the origin), in no particular order. Finds none if its
    /// coordinates are NaN.
    ///
    /// @param found   gets the points; its size is the number wanted
    /// @param limit2  squared distance within which points count
    /// @param accept  accept(slot) returns whether a point counts. It is called for points that are close enough, and
    ///                for their neighbours in the leaf order so that it can be vectorised; it must not search this way
    ///                itself
    /// @return  the number of points found: found.size(), or fewer if fewer count
    template <class Accept = AcceptAll>
    std::size_t nearest(const V& relative_position, std::span<Neighbour<T>> found,
                        T limit2 = std::numeric_limits<T>::infinity(), const Accept& accept = {}) const {
        const std::array<T, 3> position = components(relative_position);
        if (empty() || found.empty() ||
            !(position[0] == position[0] && position[1] == position[1] && position[2] == position[2]))
            return 0;
        detail::NearestPoints<T> nearest(found.size(), limit2, lanes);
        detail::NearestSearch<PointTreeView, Accept>(*this, position, accept).run(nearest);
        return nearest.put(found);
    }

private:
    [[nodiscard]] static constexpr std::array<T, 3> components(const V& v) {
        using t = vector_traits<V>;
        return {t::x(v), t::y(v), t::z(v)};
    }

    Arrays arrays_;
};

} // namespace nephroid
