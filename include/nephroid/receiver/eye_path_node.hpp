// SPDX-License-Identifier: MIT
/// @file  What an eye path map knows of its leaves and nodes beyond their points.
#pragma once

#include "nephroid/receiver/pixel_footprint.hpp"
#include "nephroid/tree/normal_cone.hpp"
#include "nephroid/tree/tree_node.hpp"
#include "nephroid/vector/not_unrolled.hpp"

#include <vector>

namespace nephroid {

/// What a map knows of a leaf beyond its points.
template <Scalar T>
struct EyePathLeaf {
    std::array<T, 3> middle, half; ///< of its box, relative to the tree's origin, and how far it reaches from there
    NormalCone<T> normals;         ///< of its vertices: one test for a whole leaf that faces a photon
    T spacing; ///< of neighbouring vertices, world units: one pixel's footprint on the surface; 0 if unknown
};

/// What a map knows of a node of the tree, of all vertices below it.
template <Scalar T>
struct EyePathNode {
    NormalCone<T> normals;
    std::array<T, 3> reach; ///< how far their pixels' footprints extend beyond them, along each axis
};

namespace detail {
/// @param box      of the leaf
/// @param normals  bounds of its normals' components
template <Scalar T>
[[nodiscard]] EyePathLeaf<T> leaf_of(const Box<T>& box, const Box<T>& normals, const T& spacing) {
    EyePathLeaf<T> leaf{{}, {}, cone_about(normals), spacing};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        leaf.middle[axis] = T(0.5) * box.low[axis] + T(0.5) * box.high[axis];
        // From the middle as it was rounded: else a vertex far from the origin may lie outside.
        leaf.half[axis] = (std::max)(box.high[axis] - leaf.middle[axis], leaf.middle[axis] - box.low[axis]);
    }
    return leaf;
}

/// The bounds of the components of a leaf's normals.
///
/// @param components  by slot, those that repeat the last one included
template <Scalar T>
[[nodiscard]] Box<T> normal_bounds(const std::array<std::vector<T>, 3>& components, const TreeLeaf& leaf) {
    Box<T> box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const T* const component = components[axis].data() + leaf.first;
        std::array<T, leaf_lanes> low, high; // of every sixteenth slot: as many at once as there are lanes
        std::copy_n(component, leaf_lanes, low.begin());
        high = low;
        for (std::size_t first = leaf_lanes; first < leaf.size; first += leaf_lanes) {
            NEPHROID_NOT_UNROLLED
            for (std::size_t i = 0; i < leaf_lanes; ++i) {
                const T x = component[first + i];
                low[i] = x < low[i] ? x : low[i];
                high[i] = high[i] < x ? x : high[i];
            }
        }
        box.low[axis] = *std::min_element(low.begin(), low.end());
        box.high[axis] = *std::max_element(high.begin(), high.end());
    }
    return box;
}

/// How far a square extends along each axis from its middle, at most, whichever way it is turned.
///
/// @param normals  bounds of what its normal may be
template <Scalar T>
[[nodiscard]] std::array<T, 3> square_reach(const Box<T>& normals, const T& side) {
    std::array<T, 3> reach;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const T low = normals.low[axis], high = normals.high[axis];
        const T least = low > T(0) ? low : high < T(0) ? -high : T(0); // of the normal along the axis
        // Half of a diagonal, as far as it may point along the axis; normals are of unit length to a hundredth.
        const T across2 = T(1) - square((std::min)(least, T(1)));
        reach[axis] = side * sqrt(T(0.5) * across2 + T(16) * std::numeric_limits<T>::epsilon());
    }
    return reach;
}

/// How far a parallelogram extends along each axis from its middle.
template <Vector3 V>
[[nodiscard]] std::array<scalar_t<V>, 3> reach_of(const PixelFootprint<V>& footprint) {
    using t = vector_traits<V>;
    using T = scalar_t<V>;
    const auto half = [](const T& u, const T& v) { return T(0.5) * (abs(u) + abs(v)); };
    return {half(t::x(footprint.u), t::x(footprint.v)), half(t::y(footprint.u), t::y(footprint.v)),
            half(t::z(footprint.u), t::z(footprint.v))};
}

template <Scalar T>
void add_reach(std::array<T, 3>& reach, const std::array<T, 3>& other) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        reach[axis] = (std::max)(reach[axis], other[axis]);
}
} // namespace detail

} // namespace nephroid
