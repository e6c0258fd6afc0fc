// SPDX-License-Identifier: MIT
/// @file  A first guess of how far the neighbours of a photon reach.
#pragma once

#include "nephroid/tree/point_tree.hpp"
#include "nephroid/vector/scalar.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace nephroid::detail {

/// Guesses how far `wanted` neighbours of each photon in a leaf reach, before any search: as if the leaf's photons
/// filled the two longer sides of its box.
template <class Tree, Scalar T>
void guess_reach(const Tree& tree, const TreeLeaf& leaf, std::size_t wanted, std::vector<T>& reach) {
    std::array<T, 3> side;
    const T* const coordinates[3] = {tree.x(), tree.y(), tree.z()};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const T* const first = coordinates[axis] + leaf.first;
        const auto [low, high] = std::minmax_element(first, first + leaf.size);
        side[axis] = *high - *low;
    }
    std::sort(side.begin(), side.end());
    // Half as much again, so that the guess is hardly ever too short.
    const T area = T(1.5) * side[2] * (std::max)(side[1], side[2] / T(leaf.size));
    std::fill_n(reach.begin() + leaf.first, leaf.size, sqrt(T(wanted) * area / (pi<T> * T(leaf.size))));
}

} // namespace nephroid::detail
