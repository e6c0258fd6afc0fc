// SPDX-License-Identifier: MIT
/// @file  The inner loop of photon rays: adds one flight's light to the vertices of one leaf.
#pragma once

#include "nephroid/ray/ray_splat.hpp"
#include "nephroid/receiver/sums.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>

namespace nephroid::detail {

/// By how much a beam is narrowed at a vertex, such that none of its disk there began beside the emitter.
///
/// The vertex's own line meets the emitter's plane at the height z above the vertex's tangent plane. Moved by q it does
/// so at z + q·g, with g = n + m c/(ω·m), c = −ω·n. include/nephroid/README.md, "Beams".
///
/// @param height  of the vertex over the emitter's plane
/// @param facing  −ω·n at the vertex
/// @param leaving ω·m at the emitter, > 0
/// @param normals n·m
/// @param radius  of the beam there
/// @return  in (0, 1], 1 if it is not narrowed
template <Scalar T>
[[nodiscard]] T clip_at_emitter(T height, T facing, T leaving, T normals, T radius, T least_radius) {
    const T ratio = facing / leaving, z = height * ratio;
    const T g2 = T(1) + ratio * (T(2) * normals + ratio);
    // Opposite and parallel planes have g = 0. Its rounding is that of terms of size 1 + ratio².
    if (!(g2 > T(16) * std::numeric_limits<T>::epsilon() * (T(1) + ratio * ratio)))
        return T(1);
    const T clipped = z / sqrt(g2), wanted = clipped > least_radius ? clipped : least_radius;
    return wanted < radius ? wanted / radius : T(1);
}

/// The kernel's value times the cosine at each vertex of a leaf: what a unit of flux makes there.
template <Vector3 V, Flux F, class Policies>
void ray_weights(const RaySplat<V, F>& ray, bool checks_ends, std::uint32_t leaf, const EyePathMap<V>& map,
                 const Policies& policies, std::array<scalar_t<V>, PointTree<V>::leaf_size>& weight) {
    using T = scalar_t<V>;
    using t = vector_traits<V>;
    const std::size_t first = map.tree().leaves()[leaf].first, size = slots_of(map.tree().leaves()[leaf]);
    const T* const x = map.tree().x() + first;
    const T* const y = map.tree().y() + first;
    const T* const z = map.tree().z() + first;
    const T* const nx = map.normal_x() + first;
    const T* const ny = map.normal_y() + first;
    const T* const nz = map.normal_z() + first;
    const Beam<V> beam = ray.beam;
    const T ox = t::x(beam.origin), oy = t::y(beam.origin), oz = t::z(beam.origin);
    const T dx = t::x(beam.direction), dy = t::y(beam.direction), dz = t::z(beam.direction);
    const T ax = t::x(beam.frame.u), ay = t::y(beam.frame.u), az = t::z(beam.frame.u);
    const T bx = t::x(beam.frame.v), by = t::y(beam.frame.v), bz = t::z(beam.frame.v);
    const T mx = t::x(ray.origin_normal), my = t::y(ray.origin_normal), mz = t::z(ray.origin_normal);
    const bool leaves_surface = mx != T(0) || my != T(0) || mz != T(0);
    // By more than rounding, so that what leaves one side of a thin sheet does not light the other.
    const T behind = leaves_surface ? ray.rounding : T(-1), last = ray.depth[1];
    using Border = std::remove_cvref_t<decltype(policies.border)>;
    for (std::size_t i = 0; i < size; ++i) {
        const T px = x[i] - ox, py = y[i] - oy, pz = z[i] - oz;
        const T depth = px * dx + py * dy + pz * dz;
        const T facing = -(nx[i] * dx + ny[i] * dy + nz[i] * dz), height = px * mx + py * my + pz * mz;
        const typename Beam<V>::At at = beam.at(depth);
        T radius2 = beam.radius2(at, px * ax + py * ay + pz * az, px * bx + py * by + pz * bz);
        T inverse_area = T(1) / sqrt(at.determinant);
        if constexpr (!std::same_as<Border, WholeWidth>)
            if (leaves_surface && facing > T(0)) {
                const T along = (depth - ray.depth[0]) / (ray.depth[1] - ray.depth[0]);
                const T radius = ray.outer_radius[0] + along * (ray.outer_radius[1] - ray.outer_radius[0]);
                const T narrowed =
                    clip_at_emitter(height, facing, mx * dx + my * dy + mz * dz, nx[i] * mx + ny[i] * my + nz[i] * mz,
                                    radius, T(policies.border.least_radius));
                radius2 = radius2 / square(narrowed);
                inverse_area = inverse_area / square(narrowed);
            }
        const bool receives = bool(int(depth > T(0)) & int(depth < last) & int(facing > T(0)) & int(height > behind) &
                                   int(at.determinant > T(0)) & int(radius2 < T(1)));
        weight[i] = keep_if(receives, policies.kernel(radius2) * inverse_area * facing);
    }
    if (!checks_ends)
        return;
    const T ex = t::x(ray.end), ey = t::y(ray.end), ez = t::z(ray.end);
    const T kx = t::x(ray.end_normal), ky = t::y(ray.end_normal), kz = t::z(ray.end_normal);
    for (std::size_t i = 0; i < size; ++i) {
        const T depth = (x[i] - ox) * dx + (y[i] - oy) * dy + (z[i] - oz) * dz;
        const T px = x[i] - ex, py = y[i] - ey, pz = z[i] - ez;
        const BehindEnd<T> vertex{px * kx + py * ky + pz * kz, px * px + py * py + pz * pz, ray.end_radius2,
                                  ray.rounding};
        weight[i] = keep_if(bool(int(depth <= ray.distance) | int(policies.ends(vertex))), weight[i]);
    }
}

/// Adds flux · weight (· response) at the vertices of a leaf.
template <Vector3 V, Flux F, class R>
void add_weights(const RaySplat<V, F>& ray, const std::array<scalar_t<V>, PointTree<V>::leaf_size>& weight,
                 std::uint32_t leaf, Sums<V, F, R>& sums) {
    using T = scalar_t<V>;
    const TreeLeaf at = sums.map().tree().leaves()[leaf];
    if constexpr (std::is_same_v<R, Irradiance>) {
        F* const sum = sums.of_leaf(leaf).data();
        for (std::size_t i = 0; i < at.size; ++i)
            sum[i] = sum[i] + ray.flux * weight[i];
    } else {
        for (std::size_t i = 0; i < at.size; ++i)
            if (weight[i] > T(0))
                sums.add(at.first + i,
                         sums.responded(at.first + i, static_cast<F>(ray.flux * weight[i]), ray.beam.direction));
    }
}

} // namespace nephroid::detail
