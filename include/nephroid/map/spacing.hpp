// SPDX-License-Identifier: MIT
/// @file  How far apart neighbouring points of a surface's sampling are.
#pragma once

#include "nephroid/vector/scalar.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace nephroid {

namespace detail {
template <Scalar T>
using Point3 = std::array<T, 3>;

template <Scalar T>
[[nodiscard]] T distance2(const Point3<T>& a, const Point3<T>& b) {
    return square(a[0] - b[0]) + square(a[1] - b[1]) + square(a[2] - b[2]);
}

/// The points in the order of their distance from a place, the nearest `count` of them sorted.
template <Scalar T>
void sort_nearest(std::vector<Point3<T>>& points, const Point3<T>& place, std::size_t count) {
    std::partial_sort(points.begin(), points.begin() + std::ptrdiff_t(count), points.end(),
                      [&](const auto& a, const auto& b) { return distance2(a, place) < distance2(b, place); });
}
} // namespace detail

/// The spacing p of a small cloud of points that sample a surface, such that a square lattice of side p gives p:
/// from the distances to their nearest neighbours of the few points that lie nearest to the cloud's middle, whose
/// neighbourhoods are whole.
///
/// The neighbours of a lattice point are at p (four), √2 p (four), so the mean squared distance to the nearest eight
/// is 1.5 p²; a lattice stretched by foreshortening gives a spacing between its two sides, a random sampling of
/// density ρ about 0.95/√ρ. With fewer points the neighbours at hand are taken, by the same rule. Points in the same
/// place count once.
///
/// @return  world units; 0 if all points coincide or there is only one
template <Scalar T>
[[nodiscard]] T point_spacing(std::span<const T> x, std::span<const T> y, std::span<const T> z) {
    constexpr std::size_t most_neighbours = 8, most_probes = 4;
    std::vector<detail::Point3<T>> points(x.size());
    detail::Point3<T> middle{T(0), T(0), T(0)};
    for (std::size_t i = 0; i < points.size(); ++i) {
        points[i] = {x[i], y[i], z[i]};
        for (std::size_t axis = 0; axis < 3; ++axis)
            middle[axis] = middle[axis] + points[i][axis] / T(points.size());
    }
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 2)
        return T(0);

    const std::size_t probes = (std::min)(most_probes, points.size());
    const std::size_t neighbours = (std::min)(most_neighbours, points.size() - 1);
    // The squared distances of the first n lattice neighbours add up to n p² for n <= 4 and to (2 n − 4) p² beyond.
    const T lattice = neighbours <= 4 ? T(neighbours) : T(2 * neighbours - 4);

    detail::sort_nearest(points, middle, probes);
    const std::vector<detail::Point3<T>> centres(points.begin(), points.begin() + std::ptrdiff_t(probes));
    std::vector<T> spacing2(probes);
    for (std::size_t i = 0; i < probes; ++i) {
        detail::sort_nearest(points, centres[i], neighbours + 1); // itself comes first, at distance 0
        T sum(0);
        for (std::size_t k = 1; k <= neighbours; ++k)
            sum = sum + detail::distance2(points[k], centres[i]);
        spacing2[i] = sum / lattice;
    }
    std::sort(spacing2.begin(), spacing2.end());
    return sqrt(T(0.5) * (spacing2[(probes - 1) / 2] + spacing2[probes / 2]));
}

} // namespace nephroid
