// SPDX-License-Identifier: MIT
/// @file  Estimates the spacing of points that sample a surface.
#pragma once

#include "nephroid/tree/smallest.hpp"
#include "nephroid/vector/not_unrolled.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

namespace nephroid::detail {

/// A small set of points, with an array for each coordinate so that loops over them are vectorised.
template <Scalar T>
struct FewPoints {
    /// Coincident points count once. The time is quadratic in the number of points.
    FewPoints(std::span<const T> px, std::span<const T> py, std::span<const T> pz)
        : room(4 * px.size()), x(room.data()), y(x + px.size()), z(y + px.size()), distance2(z + px.size()),
          size(px.size()) {
        const std::array<std::span<const T>, 3> coordinates{px, py, pz};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::span<const T> coordinate = coordinates[axis];
            std::copy(coordinate.begin(), coordinate.end(), room.data() + size * axis);
            middle[axis] = std::accumulate(coordinate.begin(), coordinate.end(), T(0)) / T(size);
        }
        measure(middle[0], middle[1], middle[2]);
        if (some_equally_far()) {
            skip_duplicates();
            measure(middle[0], middle[1], middle[2]);
        }
    }

    FewPoints(const FewPoints&) = delete; // has pointers into its own memory
    FewPoints& operator=(const FewPoints&) = delete;

    /// Computes the squared distances of all points to a given one.
    void measure(T px, T py, T pz) {
        for (std::size_t i = 0; i < size; ++i)
            distance2[i] = square(x[i] - px) + square(y[i] - py) + square(z[i] - pz);
    }

    /// The nearest points by the distances measured last.
    ///
    /// @param found  gets their indices; its size is the number wanted, at most `size`
    void nearest(std::span<std::size_t> found) const {
        T high(0);
        for (std::size_t i = 0; i < size; ++i)
            high = distance2[i] > high ? distance2[i] : high;
        auto [limit, at_limit] = limit_of_smallest<T>({distance2, size}, found.size(), 0, high);
        std::size_t count = 0;
        for (std::size_t i = 0; i < size; ++i) {
            const bool is_at_limit = at_limit > 0 && distance2[i] == limit;
            at_limit -= std::size_t(is_at_limit);
            if (is_at_limit || distance2[i] < limit)
                found[count++] = i;
        }
    }

    /// For each of N points, the sum of the squared distances to its nearest points, including itself.
    ///
    /// @param wanted  number of nearest points, at most `most`
    template <std::size_t most, std::size_t N>
    [[nodiscard]] std::array<T, N> sums_of_nearest(const std::array<std::size_t, N>& centres,
                                                   std::size_t wanted) const {
        std::array<T, N> cx, cy, cz;
        for (std::size_t k = 0; k < N; ++k)
            cx[k] = x[centres[k]], cy[k] = y[centres[k]], cz[k] = z[centres[k]];
        // Inserts every point into the N sorted lists at once, by exchanges without branches.
        std::array<std::array<T, N>, most> lists;
        for (auto& places : lists)
            places.fill(std::numeric_limits<T>::infinity());
        for (std::size_t i = 0; i < size; ++i) {
            std::array<T, N> sinking;
            NEPHROID_NOT_UNROLLED
            for (std::size_t k = 0; k < N; ++k)
                sinking[k] = square(x[i] - cx[k]) + square(y[i] - cy[k]) + square(z[i] - cz[k]);
            for (std::size_t rank = 0; rank < wanted; ++rank) {
                const std::array<T, N> own = sinking, other = lists[rank];
                NEPHROID_NOT_UNROLLED
                for (std::size_t k = 0; k < N; ++k)
                    lists[rank][k] = own[k] < other[k] ? own[k] : other[k];
                NEPHROID_NOT_UNROLLED
                for (std::size_t k = 0; k < N; ++k)
                    sinking[k] = own[k] < other[k] ? other[k] : own[k];
            }
        }
        std::array<T, N> sums{};
        for (std::size_t rank = 0; rank < wanted; ++rank)
            for (std::size_t k = 0; k < N; ++k)
                sums[k] = sums[k] + lists[rank][k];
        return sums;
    }

    std::vector<T> room;
    T *x, *y, *z, *distance2;
    std::size_t size;
    std::array<T, 3> middle;

private:
    /// Whether two points have the same distance: coincident points have, others hardly ever.
    [[nodiscard]] bool some_equally_far() const {
        int met = 0;
        for (std::size_t i = 1; i < size; ++i)
            for (std::size_t j = 0; j < i; ++j)
                met |= int(distance2[j] == distance2[i]);
        return met != 0;
    }

    void skip_duplicates() {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < size; ++i) {
            int met = 0;
            for (std::size_t j = 0; j < kept; ++j)
                met |= int(x[j] == x[i]) & int(y[j] == y[i]) & int(z[j] == z[i]);
            x[kept] = x[i], y[kept] = y[i], z[kept] = z[i];
            kept += std::size_t(met == 0);
        }
        size = kept;
    }
};

/// How many points near the middle of a cloud are measured, and how many neighbours of each at most. (Not in the
/// function below, because nvcc 12 does not accept constants of a function template as the size of an array.)
inline constexpr std::size_t spacing_probes = 4, spacing_neighbours = 8;

/// Sorts four numbers, none of them NaN. g++ 14 and later warn of array bounds where std::sort gets so few.
template <Scalar T>
void sort_four(std::array<T, 4>& numbers) {
    const auto order = [&](std::size_t low, std::size_t high) {
        const T a = numbers[low], b = numbers[high];
        numbers[low] = b < a ? b : a;
        numbers[high] = b < a ? a : b;
    };
    order(0, 1);
    order(2, 3);
    order(0, 2);
    order(1, 3);
    order(1, 2);
}
/// The spacing p of a small cloud of points that sample a surface. For a square lattice it is the lattice's side. It is
/// computed from the few points nearest to the cloud's middle, because their neighbours are all in the cloud, and from
/// the distances of these points to their nearest neighbours.
///
/// A lattice point has four neighbours at p and four at √2 p, so the mean squared distance to the nearest eight is
/// 1.5 p². A lattice stretched by foreshortening gives a spacing between its two sides, and a random sampling of
/// density ρ about 0.95/√ρ. With fewer points, the same rule is applied to the neighbours there are. Coincident
/// points count once.
///
/// @return  world units; 0 if all points coincide or there is only one
template <Scalar T>
[[nodiscard]] T point_spacing(std::span<const T> x, std::span<const T> y, std::span<const T> z) {
    FewPoints<T> points(x, y, z);
    if (points.size < 2)
        return T(0);
    const std::size_t probes = (std::min)(detail::spacing_probes, points.size);
    const std::size_t neighbours = (std::min)(detail::spacing_neighbours, points.size - 1);
    // The squared distances of the first n lattice neighbours add up to n p² for n <= 4 and to (2 n − 4) p² beyond.
    const T lattice = neighbours <= 4 ? T(neighbours) : T(2 * neighbours - 4);

    std::array<std::size_t, spacing_probes> centres{};
    points.nearest({centres.data(), probes});
    std::array<T, spacing_probes> spacing2 =
        points.template sums_of_nearest<detail::spacing_neighbours + 1>(centres, neighbours + 1);
    for (std::size_t k = 0; k < spacing2.size(); ++k) // points that were not measured are sorted last
        spacing2[k] = k < probes ? spacing2[k] / lattice : std::numeric_limits<T>::infinity();
    sort_four(spacing2);
    return sqrt(T(0.5) * (spacing2[(probes - 1) / 2] + spacing2[probes / 2]));
}

} // namespace nephroid::detail
