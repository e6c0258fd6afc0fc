// SPDX-License-Identifier: MIT
/// @file  Blocks, a few neighbouring quads of a patch of light, and how they are added to a vertex: edge by edge.
///
/// Each quad has a density w, its flux over its signed area. An edge between two quads is integrated once, weighted by
/// the jump of density across it, as its two sides' integrals differ in sign alone:
///
///     E = Σ_edges (w_left − w_right) · edge_integral / (n · n_vertex)
///
/// [include/nephroid/README.md, "Each edge once"]. No division by an area is left in the loop.
#pragma once

#include "nephroid/emission/flux.hpp"
#include "nephroid/sheet/edge_pages.hpp"
#include "nephroid/sheet/pixel_coverage.hpp"
#include "nephroid/sheet/receiver_pixels.hpp"
#include "nephroid/vector/not_unrolled.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nephroid::detail {

/// One flat piece of a sheet: edges across which the density jumps, or a single `LooseTriangle`.
template <Vector3 V, Flux F>
struct SheetBlock {
    using T = scalar_t<V>;

    Box<T> box;                             ///< of its corners, grown by the thickness; relative to the tree's origin
    std::array<T, 3> middle;                ///< relative to the tree's origin
    std::array<T, 3> normal;                ///< unit, on the side that the light comes from
    T thickness;                            ///< vertices nearer to its plane than this are on its surface, world units
    std::array<std::array<T, 3>, 2> across; ///< unit vectors in its plane, across its sides; zero for a triangle
    std::array<T, 2> low, high;             ///< how far it reaches from the middle along these
    T doubtful;                             ///< a sum below this may be rounding alone
    F flux;                                 ///< of the whole patch or triangle
    V direction;                            ///< of flight, unit, in the middle
    std::span<const EdgeGroup<T>> edges;    ///< none for a triangle
    std::uint32_t triangle;                 ///< its index in SheetPieces
};

/// A triangle that is added by the share of its area in a footprint: a part of a cut cell, or one with too little area
/// for a density. Its corners are relative to the tree's origin.
using LooseTriangle = std::array<Double3, 3>;

/// Blocks in the order in which they are added.
template <Vector3 V, Flux F>
struct SheetPieces {
    using T = scalar_t<V>;
    std::vector<SheetBlock<V, F>> blocks;
    EdgePages<T> edges;
    std::vector<LooseTriangle> triangles;

    void clear() {
        blocks.clear();
        edges.clear();
        triangles.clear();
    }
};

/// Which vertices of a group may be lit by a block: a bit for each.
///
/// @param reach  of the group's leaf
template <Vector3 V, Flux F>
[[nodiscard]] std::uint32_t vertices_near(const SheetBlock<V, F>& block, const PixelGroup<scalar_t<V>>& group,
                                          const std::array<scalar_t<V>, 3>& reach) {
    using T = scalar_t<V>;
    constexpr std::size_t most = PixelGroup<T>::most;
    const auto along = [&](const std::array<T, 3>& axis) {
        return abs(axis[0]) * reach[0] + abs(axis[1]) * reach[1] + abs(axis[2]) * reach[2];
    };
    const auto &n = block.normal, &a = block.across[0], &b = block.across[1];
    const T reach_a = along(a), reach_b = along(b);
    const T low_a = block.low[0] - reach_a, high_a = block.high[0] + reach_a;
    const T low_b = block.low[1] - reach_b, high_b = block.high[1] + reach_b;
    const T low_x = block.box.low[0] - reach[0], high_x = block.box.high[0] + reach[0];
    const T low_y = block.box.low[1] - reach[1], high_y = block.box.high[1] + reach[1];
    const T cx = block.middle[0], cy = block.middle[1], cz = block.middle[2], thickness = block.thickness;
    std::array<std::int32_t, most> is_near;
    for (std::size_t i = 0; i < most; ++i) {
        const T x = group.position[0][i], y = group.position[1][i], z = group.position[2][i];
        const T dx = x - cx, dy = y - cy, dz = z - cz;
        const T height = n[0] * dx + n[1] * dy + n[2] * dz;
        const T s = a[0] * dx + a[1] * dy + a[2] * dz, t = b[0] * dx + b[1] * dy + b[2] * dz;
        is_near[i] = std::int32_t(int(x >= low_x) & int(x <= high_x) & int(y >= low_y) & int(y <= high_y) &
                                  int(abs(height) <= thickness) & int(s >= low_a) & int(s <= high_a) & int(t >= low_b) &
                                  int(t <= high_b));
    }
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < most; ++i)
        bits |= std::uint32_t(is_near[i]) << i;
    return bits & ((std::uint32_t(1) << group.size) - 1u);
}

/// Σ jump · edge_integral over a block's edges, in the footprint of one vertex.
template <Scalar T>
[[nodiscard]] T sum_of_edges(std::span<const EdgeGroup<T>> edges, const PixelRecord<T>& pixel,
                             const std::array<T, 3>& middle) {
    constexpr std::size_t lanes = EdgeGroup<T>::lanes;
    const auto &u = pixel.row_u, &v = pixel.row_v;
    const T dx = middle[0] - pixel.position[0], dy = middle[1] - pixel.position[1], dz = middle[2] - pixel.position[2];
    const T s = u[0] * dx + u[1] * dy + u[2] * dz + T(0.5), t = v[0] * dx + v[1] * dy + v[2] * dz + T(0.5);
    const T ux = u[0], uy = u[1], uz = u[2], vx = v[0], vy = v[1], vz = v[2];
    std::array<T, lanes> sum{};
    for (const EdgeGroup<T>& e : edges) {
        NEPHROID_NOT_UNROLLED
        for (std::size_t i = 0; i < lanes; ++i) {
            const T ax = e.a[0][i], ay = e.a[1][i], az = e.a[2][i];
            const T bx = e.b[0][i], by = e.b[1][i], bz = e.b[2][i];
            sum[i] +=
                e.jump[i] * edge_integral<T>(s + (ux * ax + uy * ay + uz * az), t + (vx * ax + vy * ay + vz * az),
                                             s + (ux * bx + uy * by + uz * bz), t + (vx * bx + vy * by + vz * bz));
        }
    }
    return ((sum[0] + sum[4]) + (sum[2] + sum[6])) + ((sum[1] + sum[5]) + (sum[3] + sum[7]));
}

/// Whether a block's edges lie beside a vertex's footprint, all on one side of it.
template <Scalar T>
[[nodiscard]] bool is_beside(std::span<const EdgeGroup<T>> edges, const PixelRecord<T>& pixel,
                             const std::array<T, 3>& middle) {
    T low_s(2), high_s(-1), low_t(2), high_t(-1);
    const auto take = [&](T x, T y, T z) {
        x = x + (middle[0] - pixel.position[0]), y = y + (middle[1] - pixel.position[1]),
        z = z + (middle[2] - pixel.position[2]);
        const T s = pixel.row_u[0] * x + pixel.row_u[1] * y + pixel.row_u[2] * z + T(0.5);
        const T t = pixel.row_v[0] * x + pixel.row_v[1] * y + pixel.row_v[2] * z + T(0.5);
        low_s = (std::min)(low_s, s), high_s = (std::max)(high_s, s);
        low_t = (std::min)(low_t, t), high_t = (std::max)(high_t, t);
    };
    for (const EdgeGroup<T>& e : edges)
        for (std::size_t i = 0; i < EdgeGroup<T>::lanes; ++i)
            if (e.jump[i] != T(0)) {
                take(e.a[0][i], e.a[1][i], e.a[2][i]);
                take(e.b[0][i], e.b[1][i], e.b[2][i]);
            }
    return !(low_s < T(1) && high_s > T(0) && low_t < T(1) && high_t > T(0));
}

/// The irradiance that a block of unit flux gives to a vertex.
template <Vector3 V, Flux F>
[[nodiscard]] scalar_t<V> irradiance_at(const SheetPieces<V, F>& pieces, const SheetBlock<V, F>& block,
                                        const PixelRecord<scalar_t<V>>& pixel) {
    using T = scalar_t<V>;
    const T facing =
        block.normal[0] * pixel.normal[0] + block.normal[1] * pixel.normal[1] + block.normal[2] * pixel.normal[2];
    if (!(facing > T(0)))
        return T(0);
    if (block.edges.empty()) {
        std::array<FootprintPlace<double>, 3> corners;
        for (std::size_t i = 0; i < 3; ++i) {
            const Double3& c = pieces.triangles[block.triangle][i];
            const double x = c.x - double(pixel.position[0]), y = c.y - double(pixel.position[1]),
                         z = c.z - double(pixel.position[2]);
            const auto row = [&](const std::array<T, 3>& r) {
                return double(r[0]) * x + double(r[1]) * y + double(r[2]) * z + 0.5;
            };
            corners[i] = {row(pixel.row_u), row(pixel.row_v)};
        }
        return T(covered_share(corners) * double(pixel.inverse_area));
    }
    const T sum = sum_of_edges(block.edges, pixel, block.middle);
    if (sum < block.doubtful && (!(sum > T(0)) || is_beside(block.edges, pixel, block.middle)))
        return T(0);
    return sum / facing;
}

/// Adds a block to the vertices of one leaf.
///
/// @param add  add(slot, irradiance): what a block of unit flux gives to the vertex in that slot of the tree; > 0
template <Vector3 V, Flux F, class Add>
void add_to_leaf(const SheetPieces<V, F>& pieces, const SheetBlock<V, F>& block, const ReceiverPixels<V>& pixels,
                 std::uint32_t leaf, const Add& add) {
    using T = scalar_t<V>;
    const std::uint32_t first = pixels.map().tree().leaves()[leaf].first;
    for (const PixelGroup<T>& group : pixels.groups_of(leaf)) {
        if (!group.box.overlaps(block.box))
            continue;
        for (std::uint32_t bits = vertices_near(block, group, pixels.leaves()[leaf].reach); bits != 0;
             bits &= bits - 1) {
            const std::uint32_t slot = first + group.slot[std::size_t(std::countr_zero(bits))];
            const T irradiance = irradiance_at(pieces, block, pixels.record(leaf, slot));
            if (irradiance > T(0))
                add(slot, irradiance);
        }
    }
}

} // namespace nephroid::detail
