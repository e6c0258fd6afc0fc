// SPDX-License-Identifier: MIT
/// @file  Boxes around patches, in double precision.
#pragma once

#include "nephroid/sheet/hermite_patch.hpp"
#include "nephroid/tree/box.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace nephroid::detail {

/// The box of a single point.
[[nodiscard]] inline Box<double> box_about(const Double3& p) { return {{p.x, p.y, p.z}, {p.x, p.y, p.z}}; }

/// Enlarges a box to hold a point.
inline void include(Box<double>& box, const Double3& p) {
    const std::array<double, 3> c{p.x, p.y, p.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        box.low[axis] = (std::min)(box.low[axis], c[axis]);
        box.high[axis] = (std::max)(box.high[axis], c[axis]);
    }
}

/// The box of some points.
template <std::size_t N>
[[nodiscard]] Box<double> box_about(const std::array<Double3, N>& points) {
    Box<double> box = box_about(points[0]);
    for (const Double3& p : points)
        include(box, p);
    return box;
}

[[nodiscard]] inline Box<double> grown(Box<double> box, double by) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        box.low[axis] -= by, box.high[axis] += by;
    return box;
}

template <Scalar T>
[[nodiscard]] Box<T> narrowed_box(const Box<double>& box) {
    return {{T(box.low[0]), T(box.low[1]), T(box.low[2])}, {T(box.high[0]), T(box.high[1]), T(box.high[2])}};
}

/// The box of a patch's control points as a Bézier surface: the patch lies in their convex hull.
[[nodiscard]] inline Box<double> bounds_of(const PatchCorners& c) {
    const Double3& first = c[0][0].position;
    Box<double> box = box_about(first);
    for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t j = 0; j < 2; ++j) {
            const Double3 u = (i == 0 ? 1 / 3.0 : -1 / 3.0) * c[i][j].along_u,
                          v = (j == 0 ? 1 / 3.0 : -1 / 3.0) * c[i][j].along_v;
            const Double3 both = (i == j ? 1 / 9.0 : -1 / 9.0) * adini_twist(c, i, j);
            include(box, c[i][j].position);
            include(box, c[i][j].position + u);
            include(box, c[i][j].position + v);
            include(box, c[i][j].position + (u + v) + both);
        }
    return box;
}

} // namespace nephroid::detail
