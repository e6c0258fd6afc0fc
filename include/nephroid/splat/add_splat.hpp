// SPDX-License-Identifier: MIT
/// @file  The inner loop: adds one splat to the vertices of one leaf.
#pragma once

#include "nephroid/receiver/sums.hpp"
#include "nephroid/splat/splat_reach.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

namespace nephroid::detail {

/// Adds kernel · peak (· response) at the vertices that lie inside the splat's outline, are close enough to its
/// plane, and face it.
///
/// @param meeting  which of these conditions must be checked for each vertex
template <Vector3 V, Flux F, class R, class Kernel>
void add_splat(const Splat<V, F>& splat, const LeafMeeting& meeting, std::uint32_t leaf, const Kernel kernel,
               Sums<V, F, R>& sums) {
    using T = scalar_t<V>;
    using t = vector_traits<V>;
    const EyePathMap<V>& map = sums.map();
    const std::size_t first = map.tree().leaves()[leaf].first, count = map.tree().leaves()[leaf].size;
    const std::size_t lanes = PointTree<V>::lanes, size = (count + lanes - 1) / lanes * lanes;
    std::array<T, PointTree<V>::leaf_size> weight;
    const T* const x = map.tree().x() + first;
    const T* const y = map.tree().y() + first;
    const T* const z = map.tree().z() + first;
    const T cx = t::x(splat.centre), cy = t::y(splat.centre), cz = t::z(splat.centre);
    const T ax = t::x(splat.row_a), ay = t::y(splat.row_a), az = t::z(splat.row_a);
    const T bx = t::x(splat.row_b), by = t::y(splat.row_b), bz = t::z(splat.row_b);
    for (std::size_t i = 0; i < size; ++i) {
        const T dx = x[i] - cx, dy = y[i] - cy, dz = z[i] - cz;
        const T a = ax * dx + ay * dy + az * dz;
        const T b = bx * dx + by * dy + bz * dz;
        weight[i] = kernel(a * a + b * b);
    }
    if (meeting.checks_height) {
        const T nx = t::x(splat.row_n), ny = t::y(splat.row_n), nz = t::z(splat.row_n);
        for (std::size_t i = 0; i < size; ++i) {
            const T off = nx * (x[i] - cx) + ny * (y[i] - cy) + nz * (z[i] - cz);
            weight[i] = keep_if(off * off < T(1), weight[i]);
        }
    }
    if (meeting.checks_normals) {
        const T px = t::x(splat.normal), py = t::y(splat.normal), pz = t::z(splat.normal);
        const T* const mx = map.normal_x() + first;
        const T* const my = map.normal_y() + first;
        const T* const mz = map.normal_z() + first;
        for (std::size_t i = 0; i < size; ++i)
            weight[i] = keep_if(mx[i] * px + my[i] * py + mz[i] * pz > T(0), weight[i]);
    }

    if constexpr (!Sums<V, F, R>::is_in_flux) {
        for (std::size_t i = 0; i < count; ++i)
            if (weight[i] > T(0))
                sums.add(first + i, sums.responded(first + i, splat.peak * weight[i], splat.direction));
    } else if constexpr (std::is_same_v<R, Irradiance>) {
        F* const sum = sums.of_leaf(leaf).data();
        const F peak = splat.peak;
        for (std::size_t i = 0; i < size; ++i)
            sum[i] = sum[i] + peak * weight[i];
    } else {
        F* const sum = sums.of_leaf(leaf).data();
        for (std::size_t i = 0; i < count; ++i)
            if (weight[i] > T(0))
                sum[i] = sum[i] + splat.peak * weight[i] *
                                      sums.response()(std::size_t(map.tree().index(first + i)), splat.direction);
    }
}

} // namespace nephroid::detail
