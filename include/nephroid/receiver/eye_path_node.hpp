// SPDX-License-Identifier: MIT
/// @file  The data that an eye path map stores for each leaf and each node, in addition to the points.
#pragma once

#include "nephroid/receiver/pixel_footprint.hpp"
#include "nephroid/tree/normal_cone.hpp"
#include "nephroid/tree/tree_node.hpp"
#include "nephroid/vector/not_unrolled.hpp"

#include <vector>

namespace nephroid {

/// Data of a leaf.
template <Scalar T>
struct EyePathLeaf {
    std::array<T, 3> middle, half; ///< middle of its box, relative to the tree's origin, and half of its extents
    NormalCone<T> normals;         ///< of its vertices: tests a whole leaf against a photon's direction at once
    T spacing; ///< of neighbouring vertices, world units: one pixel's footprint on the surface; 0 if unknown
};

/// Data of a node, for all vertices below it.
template <Scalar T>
struct EyePathNode {
    NormalCone<T> normals;
    std::array<T, 3> reach; ///< how far the vertices' pixel footprints extend beyond the vertices, along each axis
};

namespace detail {
/// @param box      of the leaf
/// @param normals  bounds of its normals' components
template <Scalar T>
[[nodiscard]] EyePathLeaf<T> leaf_of(const Box<T>& box, const Box<T>& normals, const T& spacing) {
    EyePathLeaf<T> leaf{{}, {}, cone_about(normals), spacing};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        leaf.middle[axis] = T(0.5) * box.low[axis] + T(0.5) * box.high[axis];
        // Computed from the rounded middle; otherwise a vertex far from the origin could lie outside.
        leaf.half[axis] = (std::max)(box.high[axis] - leaf.middle[axis], leaf.middle[axis] - box.low[axis]);
    }
    return leaf;
}

/// The bounds of the components of a leaf's normals.
///
/// @param components  by slot, including the slots that repeat the last vertex
template <Scalar T>
[[nodiscard]] Box<T> normal_bounds(const std::array<std::vector<T>, 3>& components, const TreeLeaf& leaf) {
    Box<T> box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const T* const component = components[axis].data() + leaf.first;
        std::array<T, leaf_lanes> low, high; // of every sixteenth slot, so that all lanes are computed at once
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

/// How far a square extends at most from its middle along each axis, however it is rotated in its plane.
///
/// @param normals  bounds of its normal
template <Scalar T>
[[nodiscard]] std::array<T, 3> square_reach(const Box<T>& normals, const T& side) {
    std::array<T, 3> reach;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const T low = normals.low[axis], high = normals.high[axis];
        const T least = low > T(0) ? low : high < T(0) ? -high : T(0); // of the normal along the axis
        // Half a diagonal times the largest sine between axis and normal. Normals have unit length to within 1%.
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
