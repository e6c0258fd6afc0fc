// SPDX-License-Identifier: MIT
/// @file  Gathers points for a tree: checks them, and makes them relative to an origin in their middle.
#pragma once

#include "nephroid/vector/algebra.hpp"
#include "nephroid/vector/error.hpp"
#include "nephroid/vector/text.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace nephroid::detail {

/// Points with the interface that nanoflann needs.
template <Scalar T>
struct PointCloud {
    std::vector<std::array<T, 3>> points;
    [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
    [[nodiscard]] T kdtree_get_pt(std::size_t i, std::size_t axis) const { return points[i][axis]; }
    template <class Bounds>
    bool kdtree_get_bbox(Bounds&) const {
        return false;
    }
};

/// @param count     number of points
/// @param position  position(i) -> V for i in 0 … count − 1; every one must be finite
/// @param who       the caller's name for error messages
template <Vector3 V, class Position>
[[nodiscard]] PointCloud<scalar_t<V>> gather_points(std::size_t count, Position&& position, const char* who) {
    using t = vector_traits<V>;
    PointCloud<scalar_t<V>> cloud;
    cloud.points.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const V p = position(i);
        if (!all_finite(p))
            invalid_argument(std::string(who) + ": point " + std::to_string(i) + " is at " + text_of(p) +
                             "; every position must be finite");
        cloud.points.push_back({t::x(p), t::y(p), t::z(p)});
    }
    return cloud;
}

/// The median of each coordinate, over a few thousand of the points. The middle of the bounds would not do: with a
/// stray point far away, all others would lose digits.
template <Scalar T>
[[nodiscard]] std::array<T, 3> median_of(const std::vector<std::array<T, 3>>& points) {
    const std::size_t stride = (points.size() + 4095) / 4096;
    std::array<T, 3> median;
    std::vector<T> along;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        along.clear();
        for (std::size_t i = 0; i < points.size(); i += stride)
            along.push_back(points[i][axis]);
        const auto half = along.begin() + std::ptrdiff_t(along.size() / 2);
        std::nth_element(along.begin(), half, along.end());
        median[axis] = *half;
    }
    return median;
}

/// Makes all points relative to their median.
/// @return  the median; 0 if there are no points
template <Scalar T>
std::array<T, 3> centre_on_median(PointCloud<T>& cloud) {
    if (cloud.points.empty())
        return {T(0), T(0), T(0)};
    const std::array<T, 3> origin = median_of(cloud.points);
    for (auto& p : cloud.points)
        for (std::size_t axis = 0; axis < 3; ++axis)
            p[axis] = p[axis] - origin[axis];
    return origin;
}

} // namespace nephroid::detail
