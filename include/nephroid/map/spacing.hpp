// SPDX-License-Identifier: MIT
/// @file  How far apart neighbouring points of a surface's sampling are.
#pragma once

#include "nephroid/vector/scalar.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

namespace nephroid {

namespace detail {
/// A few points, an array for each coordinate, so that loops over them are vectorised.
template <Scalar T>
struct FewPoints {
    /// Those in the same place count once. Takes time in the square of their number.
    FewPoints(std::span<const T> px, std::span<const T> py, std::span<const T> pz)
        : room(4 * px.size()), x(room.data()), y(x + px.size()), z(y + px.size()), distance2(z + px.size()) {
        for (std::size_t i = 0; i < px.size(); ++i) {
            x[size] = px[i], y[size] = py[i], z[size] = pz[i];
            int met = 0;
            for (std::size_t j = 0; j < size; ++j)
                met |= int(x[j] == px[i]) & int(y[j] == py[i]) & int(z[j] == pz[i]);
            size += std::size_t(met == 0);
        }
    }

    FewPoints(const FewPoints&) = delete; // points into its own room
    FewPoints& operator=(const FewPoints&) = delete;

    /// Squared distances of all points to a place; good until the next call.
    [[nodiscard]] std::span<T> distances2(T px, T py, T pz) {
        for (std::size_t i = 0; i < size; ++i)
            distance2[i] = square(x[i] - px) + square(y[i] - py) + square(z[i] - pz);
        return {distance2, size};
    }

    std::vector<T> room;
    T *x, *y, *z, *distance2;
    std::size_t size = 0;
};

/// Where the smallest `count` of the values are, in their order; count <= N.
template <std::size_t N, Scalar T>
[[nodiscard]] std::array<std::size_t, N> smallest(std::span<const T> values, std::size_t count) {
    std::array<std::size_t, N> found{};
    std::size_t size = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (size == count && !(values[i] < values[found[size - 1]]))
            continue;
        size += std::size_t(size < count);
        std::size_t place = size - 1;
        for (; place > 0 && values[i] < values[found[place - 1]]; --place)
            found[place] = found[place - 1];
        found[place] = i;
    }
    return found;
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
    detail::FewPoints<T> points(x, y, z);
    if (points.size < 2)
        return T(0);
    const std::size_t probes = (std::min)(most_probes, points.size);
    const std::size_t neighbours = (std::min)(most_neighbours, points.size - 1);
    // The squared distances of the first n lattice neighbours add up to n p² for n <= 4 and to (2 n − 4) p² beyond.
    const T lattice = neighbours <= 4 ? T(neighbours) : T(2 * neighbours - 4);

    std::array<T, 3> middle{T(0), T(0), T(0)};
    for (std::size_t axis = 0; const std::span<const T> coordinate : {x, y, z})
        middle[axis++] = std::accumulate(coordinate.begin(), coordinate.end(), T(0)) / T(coordinate.size());
    std::array<T, most_probes> spacing2{};
    const auto centres = detail::smallest<most_probes, T>(points.distances2(middle[0], middle[1], middle[2]), probes);
    for (std::size_t probe = 0; probe < probes; ++probe) {
        const std::size_t i = centres[probe];
        const std::span<T> distance2 = points.distances2(points.x[i], points.y[i], points.z[i]);
        const auto last = distance2.begin() + std::ptrdiff_t(neighbours);
        std::nth_element(distance2.begin(), last, distance2.end()); // its own, 0, is among them
        spacing2[probe] = std::accumulate(distance2.begin(), last + 1, T(0)) / lattice;
    }
    std::sort(spacing2.begin(), spacing2.begin() + std::ptrdiff_t(probes));
    return sqrt(T(0.5) * (spacing2[(probes - 1) / 2] + spacing2[probes / 2]));
}

} // namespace nephroid
