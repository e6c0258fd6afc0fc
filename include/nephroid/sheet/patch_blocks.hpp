// SPDX-License-Identifier: MIT
/// @file  Divides a patch of light into blocks of flat quads, and keeps those near vertices of the receiver.
#pragma once

#include "nephroid/sheet/block_edges.hpp"
#include "nephroid/sheet/block_sides.hpp"
#include "nephroid/sheet/lit_patch.hpp"
#include "nephroid/sheet/patch_bounds.hpp"
#include "nephroid/sheet/sheet_block.hpp"
#include "nephroid/sheet/tessellation.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace nephroid::detail {

/// Divides patches. Keeps no state but scratch memory.
template <Vector3 V, Flux F>
class PatchBlocks {
public:
    using T = scalar_t<V>;

    PatchBlocks(const ReceiverPixels<V>& pixels, const Tessellation& rule) : pixels_(pixels), rule_(rule) {}

    /// Adds the blocks of a patch.
    ///
    /// @param tolerance  factor of the rule's tolerances where light is dim, >= 1
    /// @param visit      visit(leaf, block number): called for every leaf of the receiver that a block may light
    /// @return  whether there is such a leaf
    template <class Visit>
    bool add(const LitPatch<V, F>& patch, double tolerance, SheetPieces<V, F>& pieces, const Visit& visit) {
        const PatchSag sag(patch);
        const double most = pixels_.largest_pixel();
        const Box<double> reach =
            grown(bounds_of(patch.corners),
                  2 * sag.sag + 0.02 * most + (std::min)(4 * sag.curvature * most * most, most / 2));
        if (!find_leaves(reach))
            return false;
        const Double3 normal =
            unit_or_zero((patch.normal[0][0] + patch.normal[0][1]) + (patch.normal[1][0] + patch.normal[1][1]));
        const PatchShape shape = shape_of(patch.corners, normal);
        const unsigned m = quads_along(shape, rule_, pixel_, tolerance);
        const bool is_flat = sag.is_flat(pixel_);
        const unsigned blocks = is_flat ? (m + 3) / 4 : m;
        const HermitePatch surface(patch.corners);
        const double bulge = 6 * shape.bend / (double(blocks) * blocks); // of a block beyond its corners
        thickness_ = sag.thickness(pixel_, m);
        bool is_seen = false;
        for (unsigned bj = 0; bj < blocks; ++bj)
            for (unsigned bi = 0; bi < blocks; ++bi) {
                const Range u{bi * m / blocks, (bi + 1) * m / blocks}, v{bj * m / blocks, (bj + 1) * m / blocks};
                if (blocks > 1 && !touches(surface, u, v, m, bulge))
                    continue;
                const double mid_u = 0.5 * (u.begin + u.end) / m, mid_v = 0.5 * (v.begin + v.end) / m;
                is_seen |= add_block(patch, surface, u, v, m,
                                     is_flat ? normal : unit_or_zero(bilinear(patch.normal, mid_u, mid_v)),
                                     unit_or_zero(bilinear(patch.direction, mid_u, mid_v)), pieces, visit);
            }
        return is_seen;
    }

    /// Adds a single flat triangle, a part of a cut cell.
    template <class Visit>
    bool add_triangle(const LooseTriangle& corners, const Double3& normal, const Double3& direction, const F& flux,
                      double thickness, SheetPieces<V, F>& pieces, const Visit& visit) {
        if (!find_leaves(grown(box_about(corners), thickness)))
            return false;
        thickness_ = thickness > 0 ? thickness : pixel_ / 50;
        return add_loose(corners, normal, direction, flux, pieces, visit);
    }

private:
    struct Range {
        unsigned begin, end;
    };

    /// Finds the leaves whose footprints a box may overlap, and the smallest pixel there.
    bool find_leaves(const Box<double>& box) {
        leaves_.clear();
        T pixel = std::numeric_limits<T>::infinity();
        pixels_.visit_leaves(narrowed_box<T>(box), [&](std::uint32_t leaf) {
            leaves_.push_back(leaf);
            pixel = (std::min)(pixel, pixels_.leaves()[leaf].pixel);
        });
        pixel_ = double(pixel);
        return !leaves_.empty();
    }

    /// Whether a block may overlap the receiver's bounds.
    [[nodiscard]] bool touches(const HermitePatch& surface, const Range& u, const Range& v, unsigned m,
                               double bulge) const {
        const auto low = surface.curve_at(double(v.begin) / m), high = surface.curve_at(double(v.end) / m);
        const double from = double(u.begin) / m, to = double(u.end) / m;
        const Double3 first = HermitePatch::on(low, from);
        Box<double> box = box_about(first);
        include(box, HermitePatch::on(low, to));
        include(box, HermitePatch::on(high, from));
        include(box, HermitePatch::on(high, to));
        return narrowed_box<T>(grown(box, bulge + thickness_)).overlaps(pixels_.bounds());
    }

    template <class Visit>
    bool add_block(const LitPatch<V, F>& patch, const HermitePatch& surface, const Range& u, const Range& v, unsigned m,
                   const Double3& normal, const Double3& direction, SheetPieces<V, F>& pieces, const Visit& visit) {
        QuadGrid grid;
        grid.columns = u.end - u.begin, grid.rows = v.end - v.begin;
        grid.share = 1.0 / (double(m) * m);
        constexpr double infinity = std::numeric_limits<double>::infinity();
        Box<double> box{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
        for (std::size_t j = 0; j <= grid.rows; ++j) {
            const auto curve = surface.curve_at(double(v.begin + j) / m);
            for (std::size_t i = 0; i <= grid.columns; ++i) {
                grid.corner[j][i] = HermitePatch::on(curve, double(u.begin + i) / m);
                include(box, grid.corner[j][i]);
            }
        }
        if (!may_light(grown(box, thickness_)))
            return false;

        SheetBlock<V, F> block{};
        for (std::size_t axis = 0; axis < 3; ++axis)
            block.middle[axis] = T(0.5 * (box.low[axis] + box.high[axis]));
        const Double3 middle{double(block.middle[0]), double(block.middle[1]), double(block.middle[2])};
        const Frame<Double3> plane = frame_about(normal);
        // Corners are rounded once and shared, so that what rounding takes from one quad its neighbour gains.
        for (std::size_t j = 0; j <= grid.rows; ++j)
            for (std::size_t i = 0; i <= grid.columns; ++i) {
                const Double3 c = grid.corner[j][i] - middle;
                grid.corner[j][i] = {double(T(c.x)), double(T(c.y)), double(T(c.z))};
                grid.in_plane[j][i] = {dot(grid.corner[j][i], plane.u), dot(grid.corner[j][i], plane.v)};
            }
        block.box = narrowed_box<T>(grown(box, thickness_));
        block.normal = {T(normal.x), T(normal.y), T(normal.z)};
        block.thickness = T(thickness_);
        set_sides(block, grid, normal);
        block.flux = patch.flux;
        block.direction = to_world<V>(direction);

        bool is_seen = false;
        BlockEdges<T> edges(grid, pixel_, [&](const auto& a, const auto& b, const auto& c, double share) {
            is_seen |= add_loose(
                {middle + grid.corner[a[0]][a[1]], middle + grid.corner[b[0]][b[1]], middle + grid.corner[c[0]][c[1]]},
                normal, direction, F(patch.flux * T(share)), pieces, visit);
        });
        block.edges = edges.append_to(pieces.edges);
        block.doubtful = T(17) * std::numeric_limits<T>::epsilon() * T(edges.largest());
        return !block.edges.empty() ? add_if_near(block, pieces, visit) : is_seen;
    }

    /// Whether a box overlaps one of the leaves found.
    [[nodiscard]] bool may_light(const Box<double>& box) const {
        const Box<T> reach = narrowed_box<T>(box);
        return std::any_of(leaves_.begin(), leaves_.end(),
                           [&](std::uint32_t leaf) { return pixels_.leaves()[leaf].box.overlaps(reach); });
    }

    /// Adds a triangle as a block of its own.
    template <class Visit>
    bool add_loose(const LooseTriangle& corners, const Double3& normal, const Double3& direction, const F& flux,
                   SheetPieces<V, F>& pieces, const Visit& visit) {
        SheetBlock<V, F> block{};
        block.box = narrowed_box<T>(grown(box_about(corners), thickness_));
        block.middle = {T(corners[0].x), T(corners[0].y), T(corners[0].z)};
        block.normal = {T(normal.x), T(normal.y), T(normal.z)};
        block.thickness = T(thickness_);
        block.flux = flux;
        block.direction = to_world<V>(direction);
        block.triangle = std::uint32_t(pieces.triangles.size());
        pieces.triangles.push_back(corners);
        return add_if_near(block, pieces, visit);
    }

    /// Keeps a block if it overlaps one of the leaves found, and visits these leaves.
    template <class Visit>
    bool add_if_near(const SheetBlock<V, F>& block, SheetPieces<V, F>& pieces, const Visit& visit) const {
        const auto number = std::uint32_t(pieces.blocks.size());
        bool is_seen = false;
        for (const std::uint32_t leaf : leaves_)
            if (pixels_.leaves()[leaf].box.overlaps(block.box)) {
                visit(leaf, number);
                is_seen = true;
            }
        if (is_seen)
            pieces.blocks.push_back(block);
        return is_seen;
    }

    const ReceiverPixels<V>& pixels_;
    const Tessellation& rule_;
    std::vector<std::uint32_t> leaves_; ///< that the patch at hand may light
    double pixel_ = 0, thickness_ = 0;
};

} // namespace nephroid::detail
