// SPDX-License-Identifier: MIT
/// @file  A view of an eye path map: only pointers, which can be copied to a device.
#pragma once

#include "nephroid/receiver/eye_path_node.hpp"
#include "nephroid/receiver/pixel_footprint.hpp"
#include "nephroid/tree/point_tree_view.hpp"

namespace nephroid {

/// The eye path vertices of an EyePathMap. Trivially copyable. It refers to arrays that the map owns, or to copies of
/// them on a device.
template <Vector3 V>
class EyePathView {
public:
    using T = scalar_t<V>;
    using vector = V;

    /// The arrays of the map, in addition to those of the tree: copy them to use the map on a device.
    struct Arrays {
        std::span<const EyePathLeaf<T>> leaves;
        std::span<const EyePathNode<T>> nodes;  ///< as the tree's
        std::array<const T*, 3> normals;        ///< by slot
        std::array<const T*, 7> footprint_rows; ///< by slot: u, v, inverse area; null if vertices have no footprints
        T diagonal;
    };

    EyePathView(const PointTreeView<V>& tree, const Arrays& arrays) : tree_(tree), arrays_(arrays) {}

    [[nodiscard]] constexpr const PointTreeView<V>& tree() const { return tree_; }
    [[nodiscard]] constexpr const Arrays& arrays() const { return arrays_; }
    [[nodiscard]] constexpr const EyePathLeaf<T>& leaf(std::uint32_t leaf) const { return arrays_.leaves[leaf]; }
    [[nodiscard]] constexpr const EyePathNode<T>& node(std::uint32_t node) const { return arrays_.nodes[node]; }
    /// Normals by slot of the tree's leaf order.
    [[nodiscard]] constexpr const T* normal_x() const { return arrays_.normals[0]; }
    [[nodiscard]] constexpr const T* normal_y() const { return arrays_.normals[1]; }
    [[nodiscard]] constexpr const T* normal_z() const { return arrays_.normals[2]; }

    /// The diagonal of the bounds of all vertices, world units.
    [[nodiscard]] constexpr T diagonal() const { return arrays_.diagonal; }

    /// The spacing of the vertices around a world position: one pixel's footprint on the surface there. 0 if the map is
    /// empty or all of its vertices coincide.
    [[nodiscard]] T spacing_at(const V& position) const {
        return tree_.empty() ? T(0) : leaf(tree_.nearest_leaf(tree_.relative(position))).spacing;
    }

    /// Whether the user gave pixel footprints; otherwise they are squares of the spacing.
    [[nodiscard]] constexpr bool has_footprints() const { return arrays_.footprint_rows[0] != nullptr; }

    /// The pixel footprint of the vertex in a slot of a leaf.
    [[nodiscard]] FootprintRows<V> footprint(std::uint32_t number, std::size_t slot) const {
        if (!has_footprints())
            return detail::square_rows(make_vector<V>(normal_x()[slot], normal_y()[slot], normal_z()[slot]),
                                       leaf(number).spacing);
        const auto row = [&](std::size_t i) { return arrays_.footprint_rows[i][slot]; };
        return {make_vector<V>(row(0), row(1), row(2)), make_vector<V>(row(3), row(4), row(5)), row(6)};
    }

    /// Calls visit(leaf) for every leaf whose vertices may lie in the volume, in leaf order. If the volume is a
    /// FacingVolume, leaves in which no vertex faces it are skipped.
    ///
    /// @param volume  relative to the tree's origin
    template <class Q, class Visit>
    void visit_leaves(const Q& volume, Visit&& visit) const {
        if constexpr (FacingVolume<Q, T>)
            tree_.visit_leaves(
                volume, [&](std::uint32_t number, const Box<T>&) { return bool(volume.faces(node(number).normals)); },
                visit);
        else
            tree_.visit_leaves(volume, visit);
    }

    /// Calls visit(leaf) for every leaf with a vertex whose pixel footprint may overlap the volume, in leaf order, with
    /// normals treated as above.
    template <class Q, class Visit>
        requires detail::MustBeVolume<Q, T>
    void visit_footprints(const Q& volume, Visit&& visit) const {
        tree_.visit_leaves(
            Everywhere{},
            [&](std::uint32_t number, const Box<T>& box) {
                const EyePathNode<T>& known = node(number);
                Box<T> grown = box;
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    grown.low[axis] = grown.low[axis] - known.reach[axis];
                    grown.high[axis] = grown.high[axis] + known.reach[axis];
                }
                if constexpr (FacingVolume<Q, T>)
                    if (!volume.faces(known.normals))
                        return false;
                return bool(volume.overlaps(grown));
            },
            visit);
    }

private:
    struct Everywhere {
        [[nodiscard]] static constexpr bool overlaps(const Box<T>&) { return true; }
    };

    PointTreeView<V> tree_;
    Arrays arrays_;
};

} // namespace nephroid
