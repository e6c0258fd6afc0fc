// SPDX-License-Identifier: MIT
/// @file  Finds the leaf nearest to a point.
#pragma once

#include "nephroid/tree/wide_node.hpp"

#include <algorithm>

namespace nephroid::detail {

/// The Chebyshev distance of a box from a point.
template <Scalar T>
[[nodiscard]] T distance_to(const Box<T>& box, const std::array<T, 3>& position) {
    T distance(0);
    for (std::size_t axis = 0; axis < 3; ++axis)
        distance = (std::max)({distance, box.low[axis] - position[axis], position[axis] - box.high[axis]});
    return distance;
}

/// The leaf whose box is nearest to a point, by the boxes' Chebyshev distance; there must be one.
template <Scalar T>
[[nodiscard]] std::uint32_t nearest_leaf(std::span<const WideNode<T>> wide, std::span<const TreeNode<T>> nodes,
                                         const std::array<T, 3>& position) {
    using Node = WideNode<T>;
    // Finds a near leaf first. Most points lie in it, and for the others it leaves little to search.
    std::uint32_t found = 0;
    T best(0);
    do {
        const std::array<T, Node::width> distance = wide[found].distances(position);
        std::size_t nearest = 0;
        for (std::size_t i = 1; i < Node::width; ++i)
            nearest = distance[i] < distance[nearest] ? i : nearest;
        best = distance[nearest];
        found = wide[found].child[nearest];
    } while ((found & Node::leaf_flag) == 0);
    found &= ~Node::leaf_flag;
    if (!(best > T(0)))
        return found;
    for (std::size_t i = 0; i < nodes.size();) {
        const T distance = distance_to(nodes[i].box, position);
        if (!(distance < best)) {
            i = nodes[i].skip;
            continue;
        }
        if (nodes[i].leaf != no_leaf) {
            best = distance;
            found = nodes[i].leaf;
        }
        ++i;
    }
    return found;
}

} // namespace nephroid::detail
