// SPDX-License-Identifier: MIT
/// @file  The spacing of the vertices around each leaf of a tree.
#pragma once

#include "nephroid/receiver/spacing.hpp"
#include "nephroid/tree/point_tree_view.hpp"

namespace nephroid::detail {

/// The spacing of the vertices around a leaf's middle. The vertices of neighbouring leaves are included, so that the
/// leaf may have any shape.
///
/// @return  world units; 0 if they all coincide
template <Vector3 V>
[[nodiscard]] scalar_t<V> leaf_spacing(const PointTreeView<V>& tree, const TreeLeaf& leaf) {
    using T = scalar_t<V>;
    const std::array<const T*, 3> coordinates = {tree.x(), tree.y(), tree.z()};
    std::array<T, 3> middle;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const T* const first = coordinates[axis] + leaf.first;
        middle[axis] = std::accumulate(first, first + leaf.size, T(0)) / T(leaf.size);
    }
    std::array<Neighbour<T>, 24> found;
    const std::size_t count =
        tree.nearest(make_vector<V>(middle[0], middle[1], middle[2]), {found.data(), found.size()});
    std::array<std::array<T, 24>, 3> around;
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t axis = 0; axis < 3; ++axis)
            around[axis][i] = coordinates[axis][found[i].slot];
    return point_spacing<T>({around[0].data(), count}, {around[1].data(), count}, {around[2].data(), count});
}

/// Replaces unknown spacings (0) by the median of the known ones.
template <Scalar T>
void fill_unknown_spacings(std::vector<T>& spacings) {
    std::vector<T> known;
    for (const T& spacing : spacings)
        if (spacing > T(0))
            known.push_back(spacing);
    if (known.empty())
        return;
    const auto middle = known.begin() + std::ptrdiff_t(known.size() / 2);
    std::nth_element(known.begin(), middle, known.end());
    for (T& spacing : spacings)
        if (!(spacing > T(0)))
            spacing = *middle;
}

} // namespace nephroid::detail
