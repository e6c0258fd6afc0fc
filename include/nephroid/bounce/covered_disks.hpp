// SPDX-License-Identifier: MIT
/// @file  Photons as disks of one radius, and sums of them over the share of a disk that lies on the surface.
#pragma once

#include "nephroid/receiver/free_distances.hpp"
#include "nephroid/splat/splatter.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace nephroid::detail {

/// Keeps every footprint as it is.
struct KeepFootprint {
    template <Vector3 V>
    [[nodiscard]] Verdict operator()(Ellipse<V>&, scalar_t<V>) const {
        return Verdict::kept;
    }
};

/// The policies of disks of one radius, under a kernel of the distance in space. On a plane that is the distance within
/// it; on a sphere it makes the kernel's integral exact [Archimedes: a cap's area is π chord²].
template <class V>
struct DiskPolicies
    : SplatPolicies<BiweightKernel, NoPixelFilter, DiscardCollapsed, KeepFootprint, FixedFootprint, FirstOrder> {
    const FreeDistances<V>* distances;

    /// Adds a disk to the vertices of a leaf. A vertex receives if its surface is one with the photon's, as free
    /// distances have it: turned by less than 60°, within a quarter of the radius of its plane, and with nothing
    /// between. So photons on the other side of a wall, or behind it, do not shine through.
    template <class F, class R>
    void add(const Splat<V, F>& disk, const LeafMeeting& meeting, std::uint32_t leaf, Sums<V, F, R>& sums) const {
        using T = scalar_t<V>;
        using t = vector_traits<V>;
        const EyePathMap<V>& map = sums.map();
        const std::size_t first = map.tree().leaves()[leaf].first, count = map.tree().leaves()[leaf].size;
        const std::size_t lanes = PointTree<V>::lanes, size = (count + lanes - 1) / lanes * lanes;
        std::array<T, PointTree<V>::leaf_size> weight;
        const T* const x = map.tree().x() + first;
        const T* const y = map.tree().y() + first;
        const T* const z = map.tree().z() + first;
        const T* const nx = map.normal_x() + first;
        const T* const ny = map.normal_y() + first;
        const T* const nz = map.normal_z() + first;
        const T cx = t::x(disk.centre), cy = t::y(disk.centre), cz = t::z(disk.centre);
        const T px = t::x(disk.normal), py = t::y(disk.normal), pz = t::z(disk.normal);
        const T scale = T(1 / square(shape.radius));
        for (std::size_t i = 0; i < size; ++i) {
            const T dx = x[i] - cx, dy = y[i] - cy, dz = z[i] - cz;
            weight[i] = keep_if(nx[i] * px + ny[i] * py + nz[i] * pz > T(one_surface_cosine),
                                kernel(scale * (dx * dx + dy * dy + dz * dz)));
        }
        if (meeting.checks_height) {
            const T hx = t::x(disk.row_n), hy = t::y(disk.row_n), hz = t::z(disk.row_n);
            for (std::size_t i = 0; i < size; ++i) {
                const T height = hx * (x[i] - cx) + hy * (y[i] - cy) + hz * (z[i] - cz);
                weight[i] = keep_if(height * height < T(1), weight[i]);
            }
        }
        distances->keep_reached(leaf, cx, cy, cz, T(shape.radius), weight);
        F* const sum = sums.of_leaf(leaf).data();
        for (std::size_t i = 0; i < count; ++i)
            if constexpr (std::is_same_v<R, Irradiance>)
                sum[i] = sum[i] + disk.peak * weight[i];
            else if (weight[i] > T(0))
                sum[i] = sum[i] + disk.peak * weight[i] *
                                      sums.response()(std::size_t(map.tree().index(first + i)), disk.direction);
    }
};

template <class V>
[[nodiscard]] DiskPolicies<V> disks_of(double radius, const FreeDistances<V>& distances) {
    return {{.shape = {radius}}, &distances};
}

/// The coverage of a disk about a vertex, bounded.
///
/// @param bounded  counts the disks that were
template <class V>
[[nodiscard]] scalar_t<V> bounded_coverage(const FreeDistances<V>& distances, std::size_t slot, scalar_t<V> radius,
                                           std::uint64_t& bounded) {
    using T = scalar_t<V>;
    const T coverage = distances.coverage(slot, radius, BiweightKernel{});
    bounded += coverage < T(least_coverage);
    return (std::max)(coverage, T(least_coverage));
}

/// Adds sums of disks, over their coverages, to other sums of the same map.
///
/// @return  the number of vertices whose coverage was bounded
template <class V, class F, class R, class E>
std::uint64_t add_over_coverage(const Sums<V, F, response_within<R>>& disks, double radius,
                                const FreeDistances<V>& distances, Sums<V, F, R>& sums, E& executor) {
    using T = scalar_t<V>;
    const auto leaves = sums.map().tree().leaves();
    std::vector<std::uint64_t> bounded(leaves.size());
    for_each_index(executor, leaves.size(), 16, [&](std::size_t leaf) {
        const std::span<const F> from = disks.of_leaf(std::uint32_t(leaf));
        for (std::size_t i = 0; i < from.size(); ++i) {
            const std::size_t slot = leaves[leaf].first + i;
            const T coverage = bounded_coverage(distances, slot, T(radius), bounded[leaf]);
            sums.add(slot, from[i] * (T(1) / coverage));
        }
    });
    std::uint64_t sum = 0;
    for (const std::uint64_t of_leaf : bounded)
        sum += of_leaf;
    return sum;
}

} // namespace nephroid::detail
