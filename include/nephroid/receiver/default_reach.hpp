// SPDX-License-Identifier: MIT
/// @file  How far surfaces are followed where nobody says it.
#pragma once

#include "nephroid/receiver/eye_path_map.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace nephroid::detail {

/// Four fifths of how far nine tenths of a map's vertices are from their median, so that a few vertices far away do
/// not matter: half of a room's width. At most a third of the map's diagonal.
///
/// @return  world units; 0 if all vertices are in one place
template <Vector3 V>
[[nodiscard]] scalar_t<V> default_reach(const EyePathMap<V>& map) {
    using T = scalar_t<V>;
    const PointTree<V>& tree = map.tree();
    const T third = map.diagonal() / T(3);
    std::vector<T> distances2;
    for (const TreeLeaf& leaf : tree.leaves())
        for (std::size_t slot = leaf.first; slot < leaf.first + leaf.size; ++slot)
            distances2.push_back(square(tree.x()[slot]) + square(tree.y()[slot]) + square(tree.z()[slot]));
    if (distances2.empty())
        return third;
    const auto quantile = distances2.begin() + std::ptrdiff_t(distances2.size() * 9 / 10);
    std::nth_element(distances2.begin(), quantile, distances2.end());
    return *quantile > T(0) ? (std::min)(third, T(0.8) * T(sqrt(*quantile))) : third;
}

} // namespace nephroid::detail
