// SPDX-License-Identifier: MIT
/// @file  The eye path map: where the camera's paths end, looked up by the footprints that fall on them.
#pragma once

#include "nephroid/receiver/spacing.hpp"
#include "nephroid/tree/point_tree.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <ranges>

namespace nephroid {

/// What the splatter knows of a leaf beyond its points.
template <Scalar T>
struct EyePathLeaf {
    std::array<T, 3> middle, half; ///< of its box, relative to the tree's origin, and how far it reaches from there
    std::array<T, 3>
        normal; ///< in the middle of its vertices' normals, none of which is further from it than `spread`:
    T spread;   ///< one test for a whole leaf that faces a photon
    T spacing;  ///< of neighbouring vertices, world units: one pixel's footprint on the surface; 0 if unknown
};

/// Eye path vertices (hits of the camera's paths on diffuse surfaces) in a kd-tree, read from the user's own array
/// through two projections; the map copies positions and normals and refers to a vertex by its index in that array.
///
/// ```cpp
/// const nephroid::EyePathMap map(vertices, &MyVertex::position, &MyVertex::normal);
/// ```
template <detail::MustBeVector V>
class EyePathMap {
public:
    using T = scalar_t<V>;
    using vector = V;

    /// @param vertices  a random-access range; may be empty, and is not needed after the call
    /// @param position  projection to V: a member pointer or a callable; finite
    /// @param normal    projection to V: unit, on the side that the camera sees; photons on the other side do not count
    /// Throws std::invalid_argument naming the vertex whose position or normal is not finite or not of unit length.
    template <std::ranges::random_access_range Vertices, class Position, class Normal>
    EyePathMap(const Vertices& vertices, Position position, Normal normal)
        : tree_(
              std::size_t(std::ranges::size(vertices)),
              [&](std::size_t i) -> V { return std::invoke(position, at(vertices, i)); }, "nephroid::EyePathMap") {
        gather_normals(vertices, normal);
        leaves_.reserve(tree_.leaves().size());
        for (const TreeNode<T>& node : tree_.nodes())
            if (node.leaf != no_leaf)
                append_leaf(tree_.leaves()[node.leaf], node.box);
        fill_unknown_spacings();
        const Box<T>& box = tree_.bounds();
        for (std::size_t axis = 0; !tree_.empty() && axis < 3; ++axis)
            diagonal_ = diagonal_ + square(box.high[axis] - box.low[axis]);
        diagonal_ = sqrt(diagonal_);
    }

    [[nodiscard]] const PointTree<V>& tree() const { return tree_; }
    [[nodiscard]] const EyePathLeaf<T>& leaf(std::uint32_t leaf) const { return leaves_[leaf]; }
    /// Normals by slot of the tree's leaf order.
    [[nodiscard]] const T* normal_x() const { return normals_[0].data(); }
    [[nodiscard]] const T* normal_y() const { return normals_[1].data(); }
    [[nodiscard]] const T* normal_z() const { return normals_[2].data(); }

    /// The diagonal of the bounds of all vertices, world units.
    [[nodiscard]] T diagonal() const { return diagonal_; }

    /// The spacing of the vertices around a world position: one pixel's footprint on the surface there. 0 when the
    /// map is empty or all of its vertices coincide.
    [[nodiscard]] T spacing_at(const V& position) const {
        return tree_.empty() ? T(0) : leaves_[tree_.nearest_leaf(tree_.relative(position))].spacing;
    }

private:
    template <class Vertices>
    [[nodiscard]] static decltype(auto) at(const Vertices& vertices, std::size_t i) {
        return std::ranges::begin(vertices)[std::ranges::range_difference_t<const Vertices>(i)];
    }

    template <class Vertices, class Normal>
    void gather_normals(const Vertices& vertices, Normal& normal) {
        using t = vector_traits<V>;
        for (auto& component : normals_)
            component.resize(tree_.slots());
        for (std::size_t slot = 0; slot < tree_.slots(); ++slot) {
            const V n = std::invoke(normal, at(vertices, tree_.index(slot)));
            if (!(abs(length2(n) - T(1)) < T(0.01)))
                invalid_argument("nephroid::EyePathMap: vertex " + std::to_string(tree_.index(slot)) +
                                 " has the normal " + detail::text_of(n) + "; normals must be of unit length");
            normals_[0][slot] = t::x(n), normals_[1][slot] = t::y(n), normals_[2][slot] = t::z(n);
        }
    }

    /// Leaves come in their own order, as the nodes do.
    void append_leaf(const TreeLeaf& leaf, const Box<T>& box) {
        const Box<T> normals = normal_bounds(leaf);
        EyePathLeaf<T>& added = leaves_.emplace_back();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            added.middle[axis] = T(0.5) * box.low[axis] + T(0.5) * box.high[axis];
            // From the middle as it was rounded: else a vertex far from the origin may lie outside.
            added.half[axis] = (std::max)(box.high[axis] - added.middle[axis], added.middle[axis] - box.low[axis]);
            added.normal[axis] = T(0.5) * normals.low[axis] + T(0.5) * normals.high[axis];
            added.spread = added.spread + square(T(0.5) * normals.high[axis] - T(0.5) * normals.low[axis]);
        }
        added.spread = sqrt(added.spread);
        added.spacing = leaf_spacing(leaf);
    }

    [[nodiscard]] Box<T> normal_bounds(const TreeLeaf& leaf) const {
        Box<T> box;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const T* const component = normals_[axis].data() + leaf.first;
            T low = component[0], high = low;
            for (std::size_t i = 1; i < leaf.size; ++i) {
                low = (std::min)(low, component[i]);
                high = (std::max)(high, component[i]);
            }
            box.low[axis] = low, box.high[axis] = high;
        }
        return box;
    }

    /// From the vertices around the leaf's middle, its own and its neighbours', so that leaves of any shape will do.
    [[nodiscard]] T leaf_spacing(const TreeLeaf& leaf) const {
        const T* const coordinates[3] = {tree_.x(), tree_.y(), tree_.z()};
        std::array<T, 3> middle;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const T* const first = coordinates[axis] + leaf.first;
            middle[axis] = std::accumulate(first, first + leaf.size, T(0)) / T(leaf.size);
        }

        constexpr std::size_t wanted = 24;
        std::array<Neighbour<T>, wanted> found;
        const std::size_t count = tree_.nearest(make_vector<V>(middle[0], middle[1], middle[2]), found);
        std::array<std::array<T, wanted>, 3> around;
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t axis = 0; axis < 3; ++axis)
                around[axis][i] = coordinates[axis][found[i].slot];
        return point_spacing<T>({around[0].data(), count}, {around[1].data(), count}, {around[2].data(), count});
    }

    /// A leaf about which all vertices coincide takes the median of the others.
    void fill_unknown_spacings() {
        std::vector<T> known;
        for (const EyePathLeaf<T>& leaf : leaves_)
            if (leaf.spacing > T(0))
                known.push_back(leaf.spacing);
        if (known.empty())
            return;
        const auto middle = known.begin() + std::ptrdiff_t(known.size() / 2);
        std::nth_element(known.begin(), middle, known.end());
        for (EyePathLeaf<T>& leaf : leaves_)
            if (!(leaf.spacing > T(0)))
                leaf.spacing = *middle;
    }

    PointTree<V> tree_;
    std::array<std::vector<T>, 3> normals_;
    std::vector<EyePathLeaf<T>> leaves_;
    T diagonal_ = T(0);
};

template <std::ranges::random_access_range Vertices, class Position, class Normal>
EyePathMap(const Vertices&, Position, Normal)
    -> EyePathMap<std::remove_cvref_t<std::invoke_result_t<Position&, std::ranges::range_reference_t<const Vertices>>>>;

} // namespace nephroid
