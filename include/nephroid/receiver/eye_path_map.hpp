// SPDX-License-Identifier: MIT
/// @file  The eye path map: a look-up over the surface points at which the camera's paths end.
#pragma once

#include "nephroid/receiver/eye_path_view.hpp"
#include "nephroid/receiver/leaf_spacing.hpp"
#include "nephroid/receiver/projection.hpp"
#include "nephroid/tree/point_tree.hpp"

namespace nephroid {

/// Eye path vertices (hits of the camera's paths on diffuse surfaces) in a kd-tree. Positions and normals are copied
/// from the user's own array through projections, and the map refers to a vertex by its index in that array.
/// EyePathView documents the look-ups.
///
/// ```cpp
/// const nephroid::EyePathMap map(vertices, &MyVertex::position, &MyVertex::normal);
/// ```
template <detail::MustBeVector V>
class EyePathMap {
public:
    using T = scalar_t<V>;
    using vector = V;

    /// @param vertices   a random-access range; may be empty, and is not needed after the call
    /// @param position   projection to V: a member pointer or a callable; finite
    /// @param normal     projection to V: unit, on the side that the camera sees; photons on the other side do not
    ///                   count
    /// @param footprint  projection to PixelFootprint<V>, or a range with one for each vertex; seven scalars per vertex
    ///                   are stored. If left out, footprints are squares of the vertices' spacing
    /// Throws std::invalid_argument naming the vertex whose position, normal or footprint is not finite, not of unit
    /// length, or without an area.
    template <std::ranges::random_access_range Vertices, class Position, class Normal,
              detail::MustProject<V, Vertices, Position, Normal> Footprint = FootprintsFromSpacing>
    EyePathMap(const Vertices& vertices, Position position, Normal normal, const Footprint& footprint = {})
        : tree_(
              std::size_t(std::ranges::size(vertices)),
              [&](std::size_t i) -> V { return std::invoke(position, detail::element_at(vertices, i)); },
              "nephroid::EyePathMap") {
        gather_normals(vertices, normal);
        std::vector<Box<T>> normals = describe_leaves();
        if constexpr (!std::same_as<Footprint, FootprintsFromSpacing>)
            gather_footprints(vertices, footprint);
        describe_nodes(normals);
        const Box<T> box = tree_.bounds();
        for (std::size_t axis = 0; !tree_.empty() && axis < 3; ++axis)
            diagonal_ = diagonal_ + square(box.high[axis] - box.low[axis]);
        diagonal_ = sqrt(diagonal_);
    }

    /// A view of the map, valid as long as the map lives.
    [[nodiscard]] EyePathView<V> view() const {
        std::array<const T*, 7> rows{};
        for (std::size_t i = 0; !rows_[0].empty() && i < rows.size(); ++i)
            rows[i] = rows_[i].data();
        return {tree_.view(),
                {{leaves_.data(), leaves_.size()},
                 {nodes_.data(), nodes_.size()},
                 {normals_[0].data(), normals_[1].data(), normals_[2].data()},
                 rows,
                 diagonal_}};
    }

    // See EyePathView.
    [[nodiscard]] const PointTree<V>& tree() const { return tree_; }
    [[nodiscard]] const EyePathLeaf<T>& leaf(std::uint32_t leaf) const { return leaves_[leaf]; }
    [[nodiscard]] const EyePathNode<T>& node(std::uint32_t node) const { return nodes_[node]; }
    [[nodiscard]] const T* normal_x() const { return normals_[0].data(); }
    [[nodiscard]] const T* normal_y() const { return normals_[1].data(); }
    [[nodiscard]] const T* normal_z() const { return normals_[2].data(); }
    [[nodiscard]] T diagonal() const { return diagonal_; }
    [[nodiscard]] T spacing_at(const V& position) const { return view().spacing_at(position); }
    [[nodiscard]] bool has_footprints() const { return !rows_[0].empty(); }
    [[nodiscard]] FootprintRows<V> footprint(std::uint32_t leaf, std::size_t slot) const {
        return view().footprint(leaf, slot);
    }
    template <class Q, class Visit>
    void visit_leaves(const Q& volume, Visit&& visit) const {
        view().visit_leaves(volume, visit);
    }
    template <class Q, class Visit>
    void visit_footprints(const Q& volume, Visit&& visit) const {
        view().visit_footprints(volume, visit);
    }

private:
    template <class Vertices, class Normal>
    void gather_normals(const Vertices& vertices, Normal& normal) {
        using t = vector_traits<V>;
        for (auto& component : normals_)
            component.resize(tree_.slots());
        for (std::size_t slot = 0; slot < tree_.slots(); ++slot) {
            const V n = std::invoke(normal, detail::element_at(vertices, tree_.index(slot)));
            if (!(abs(length2(n) - T(1)) < T(0.01)))
                invalid_argument("nephroid::EyePathMap: vertex " + std::to_string(tree_.index(slot)) +
                                 " has the normal " + detail::text_of(n) + "; normals must be of unit length");
            normals_[0][slot] = t::x(n), normals_[1][slot] = t::y(n), normals_[2][slot] = t::z(n);
        }
    }

    /// Makes the leaves, and bounds by the spacing how far their pixels' footprints reach.
    ///
    /// @return  for each node that is a leaf, the bounds of its normals
    [[nodiscard]] std::vector<Box<T>> describe_leaves() {
        const PointTreeView<V> tree = tree_.view();
        std::vector<T> spacings;
        spacings.reserve(tree.leaves().size());
        for (const TreeLeaf& leaf : tree.leaves())
            spacings.push_back(detail::leaf_spacing(tree, leaf));
        detail::fill_unknown_spacings(spacings);

        leaves_.reserve(tree.leaves().size());
        nodes_.resize(tree.nodes().size());
        std::vector<Box<T>> normals(nodes_.size(), detail::empty_box<T>());
        for (std::size_t i = 0; i < nodes_.size(); ++i) {
            const TreeNode<T>& node = tree.nodes()[i];
            if (node.leaf == no_leaf)
                continue;
            normals[i] = detail::normal_bounds(normals_, tree.leaves()[node.leaf]);
            leaves_.push_back(detail::leaf_of(node.box, normals[i], spacings[node.leaf])); // in order, as the nodes are
            nodes_[i].reach = detail::square_reach(normals[i], spacings[node.leaf]);
        }
        return normals;
    }

    template <class Vertices, class Footprint>
    void gather_footprints(const Vertices& vertices, const Footprint& footprint) {
        for (auto& row : rows_)
            row.resize(tree_.slots());
        if constexpr (std::ranges::range<const Footprint>)
            if (std::size_t(std::ranges::size(footprint)) != std::size_t(std::ranges::size(vertices)))
                invalid_argument("nephroid::EyePathMap: " + std::to_string(std::ranges::size(footprint)) +
                                 " pixel footprints for " + std::to_string(std::ranges::size(vertices)) +
                                 " vertices; there must be one for each");
        for (std::size_t i = 0; i < nodes_.size(); ++i) {
            if (tree_.nodes()[i].leaf == no_leaf)
                continue;
            const std::array<T, 3> squares = nodes_[i].reach;
            nodes_[i].reach = {};
            const TreeLeaf leaf = tree_.leaves()[tree_.nodes()[i].leaf];
            for (std::size_t slot = leaf.first; slot < leaf.first + detail::slots_of(leaf); ++slot) {
                const PixelFootprint<V> given = detail::footprint_of(vertices, footprint, tree_.index(slot));
                const bool is_unknown = detail::is_unknown(given);
                detail::add_reach(nodes_[i].reach, is_unknown ? squares : detail::reach_of(given));
                set_rows(slot, is_unknown ? detail::square_rows(normal_at(slot), leaves_[tree_.nodes()[i].leaf].spacing)
                                          : checked_rows(given, tree_.index(slot)));
            }
        }
    }

    [[nodiscard]] V normal_at(std::size_t slot) const {
        return make_vector<V>(normals_[0][slot], normals_[1][slot], normals_[2][slot]);
    }

    [[nodiscard]] static FootprintRows<V> checked_rows(const PixelFootprint<V>& footprint, std::uint32_t vertex) {
        const FootprintRows<V> rows = detail::rows_of(footprint);
        if (!all_finite(footprint.u) || !all_finite(footprint.v) || !all_finite(rows.u) || !all_finite(rows.v) ||
            !isfinite(rows.inverse_area) || !(rows.inverse_area > T(0)))
            invalid_argument("nephroid::EyePathMap: vertex " + std::to_string(vertex) +
                             " has a pixel footprint of the sides " + detail::text_of(footprint.u) + " and " +
                             detail::text_of(footprint.v) +
                             "; they must be finite and span an area, or both be zero where it is not known");
        return rows;
    }

    void set_rows(std::size_t slot, const FootprintRows<V>& rows) {
        using t = vector_traits<V>;
        rows_[0][slot] = t::x(rows.u), rows_[1][slot] = t::y(rows.u), rows_[2][slot] = t::z(rows.u);
        rows_[3][slot] = t::x(rows.v), rows_[4][slot] = t::y(rows.v), rows_[5][slot] = t::z(rows.v);
        rows_[6][slot] = rows.inverse_area;
    }

    /// Computes the bounds of the inner nodes from those of their children.
    ///
    /// @param normals  bounds of the normals for each node; on entry those of the leaves are known
    void describe_nodes(std::vector<Box<T>>& normals) {
        detail::gather_upwards<T>(tree_.nodes(), [&](std::size_t node, std::size_t child) {
            normals[node].add(normals[child]);
            detail::add_reach(nodes_[node].reach, nodes_[child].reach);
        });
        for (std::size_t i = 0; i < nodes_.size(); ++i)
            nodes_[i].normals = detail::cone_about(normals[i]);
    }

    PointTree<V> tree_;
    std::array<std::vector<T>, 3> normals_;
    std::array<std::vector<T>, 7> rows_; // of the footprints; empty where there are none
    std::vector<EyePathLeaf<T>> leaves_;
    std::vector<EyePathNode<T>> nodes_;
    T diagonal_ = T(0);
};

template <std::ranges::random_access_range Vertices, class Position, class... Others>
EyePathMap(const Vertices&, Position, Others...)
    -> EyePathMap<typename detail::ProjectedVector<Vertices, Position>::type>;

} // namespace nephroid
