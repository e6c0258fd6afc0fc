// SPDX-License-Identifier: MIT
/// @file  Turns a cell of a chart into light on the receiver: one patch if a sheet covers the cell, polygons if sheets
///        end in it.
#pragma once

#include "nephroid/sheet/cell_density.hpp"
#include "nephroid/sheet/cell_outline.hpp"
#include "nephroid/sheet/cell_tangents.hpp"
#include "nephroid/sheet/patch_blocks.hpp"
#include "nephroid/sheet/refinement.hpp"
#include "nephroid/sheet/sheet_account.hpp"
#include "nephroid/sheet/tile_pieces.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace nephroid::detail {

/// Draws the cells of one tile.
///
/// @tparam Nodes  NodeCache
template <Vector3 V, Flux F, class Nodes>
class CellPieces {
public:
    using T = scalar_t<V>;
    using Node = NodeEnd<V, F>;

    CellPieces(const Lattice& lattice, const ReceiverPixels<V>& pixels, const Tessellation& rule,
               const Brightness& brightness, Nodes& nodes, TilePieces<V, F>& tile, SheetAccount& account)
        : lattice_(lattice), pixels_(pixels), brightness_(brightness), nodes_(nodes), tile_(tile), account_(account),
          blocks_(pixels, rule) {}

    void add(const Cell& cell) {
        ++account_.cells;
        std::array<NodeEnds<V, F>, 4> corners;
        for (std::size_t k = 0; k < 4; ++k)
            corners[k] = nodes_.known(corner_of(cell, k));
        outlines_.clear();
        for (std::size_t k = 0; k < 4; ++k)
            for (const Node& end : corners[k])
                if (is_first_of(corners, k, end.signature))
                    add_sheet(cell, corners, end.signature);
        if (outlines_.empty())
            return;
        ++account_.cut_cells;
        // If each corner has exactly one end, all points of the cell are taken to have one: the light of bands too thin
        // to hold a node is shared among the outlines.
        double covered = 0;
        for (const CellOutline<V, F>& outline : outlines_)
            covered += outline.area();
        const bool is_lit_everywhere =
            std::all_of(corners.begin(), corners.end(), [](const auto& ends) { return ends.size() == 1; });
        for (const CellOutline<V, F>& outline : outlines_)
            add_outline(cell, outline, is_lit_everywhere && covered > 0 ? 1 / covered : 1);
    }

private:
    /// Corners counter-clockwise from the first.
    [[nodiscard]] static LatticePlace corner_of(const Cell& cell, std::size_t k) {
        return {cell.place.i + (k == 1 || k == 2 ? cell.step : 0), cell.place.j + (k >= 2 ? cell.step : 0)};
    }

    [[nodiscard]] static bool is_first_of(const std::array<NodeEnds<V, F>, 4>& corners, std::size_t k,
                                          std::uint32_t signature) {
        for (std::size_t before = 0; before < k; ++before)
            if (end_of<V, F>(corners[before], signature))
                return false;
        return true;
    }

    /// Draws a sheet's patch if the sheet covers the whole cell, and keeps its outlines otherwise.
    void add_sheet(const Cell& cell, const std::array<NodeEnds<V, F>, 4>& corners, std::uint32_t signature) {
        std::array<const Node*, 4> ends;
        for (std::size_t k = 0; k < 4; ++k)
            ends[k] = end_of<V, F>(corners[k], signature);
        const auto pixel = [&] { return pixel_about(ends); };
        std::array<bool, 4> is_joined;
        bool is_whole = true;
        for (std::size_t k = 0; k < 4; ++k) {
            const Node *const a = ends[k], *const b = ends[(k + 1) % 4];
            is_joined[k] = a && b && are_joined(*a, *b, pixel);
            is_whole &= is_joined[k];
            account_.parted += std::uint64_t(a && b && !is_joined[k]);
        }
        if (is_whole)
            add_patch(cell, ends, pixel);
        else
            OutlineFinder<V, F, Nodes, decltype(pixel)>(nodes_, pixel, halvings_of(cell, share_of(ends, corners)))
                .visit_pieces(cell.place, cell.step, ends, is_joined,
                              [&](const CellOutline<V, F>& outline) { outlines_.push_back(outline); });
    }

    /// The density of a sheet's light at a cell's corners, as a part of the brightest one's: 0 to 1.
    [[nodiscard]] static double share_of(const std::array<const Node*, 4>& ends,
                                         const std::array<NodeEnds<V, F>, 4>& corners) {
        double own = 0, brightest = 0;
        for (const Node* const end : ends)
            if (end)
                own = (std::max)(own, flux_traits<F>::power(end->density));
        for (const NodeEnds<V, F>& all : corners)
            for (const Node& end : all)
                brightest = (std::max)(brightest, flux_traits<F>::power(end.density));
        return brightest > 0 ? own / brightest : 1;
    }

    /// How often a cell's sides are halved: down to the same length for cells of all sizes, but at least twice. Of a
    /// dim sheet once less for each halving of its light, so that what may be misplaced is the same for all: glass has
    /// many dim sheets, and each node is all of their paths.
    [[nodiscard]] unsigned halvings_of(const Cell& cell, double share) const {
        unsigned halvings = Lattice::bisections;
        for (std::int64_t step = cell.step; step < lattice_.step() && halvings > 2; step *= 2)
            --halvings;
        for (; share <= 0.5 && halvings > 0; share *= 2)
            --halvings;
        return halvings;
    }

    template <class Pixel>
    void add_patch(const Cell& cell, const std::array<const Node*, 4>& ends, const Pixel& pixel) {
        const auto known = [&](const LatticePlace& place) { return nodes_.known(place); };
        constexpr std::size_t number[2][2] = {{0, 3}, {1, 2}}; // of the corner at u = i, v = j
        LitPatch<V, F> patch{};
        for (std::size_t i = 0; i < 2; ++i)
            for (std::size_t j = 0; j < 2; ++j) {
                const std::size_t k = number[i][j];
                const LatticePlace place = corner_of(cell, k);
                patch.corners[i][j] = {double3(ends[k]->position),
                                       change_along<V, F>(*ends[k], place, {cell.step, 0}, known, pixel),
                                       change_along<V, F>(*ends[k], place, {0, cell.step}, known, pixel)};
                patch.normal[i][j] = double3(ends[k]->normal);
                patch.direction[i][j] = double3(ends[k]->direction);
            }
        patch.flux = static_cast<F>(mean_density<V, F>(cell, ends, known) * T(area_of(cell)));
        const bool is_seen =
            blocks_.add(patch, square(brightness_.allowance(mean_irradiance(patch))), tile_.pieces, visitor());
        account_.book(patch.flux, is_seen, false);
    }

    void add_outline(const Cell& cell, const CellOutline<V, F>& outline, double scale) {
        Double3 normal{}, direction{};
        F density = flux_traits<F>::zero();
        double sag = 0, size2 = 0;
        std::array<Double3, 6> place;
        for (std::size_t i = 0; i < outline.size; ++i) {
            const Node& node = outline.points[i].node;
            place[i] = double3(node.position);
            normal = normal + double3(node.normal);
            direction = direction + double3(node.direction);
            density = density + node.density;
        }
        for (std::size_t i = 0; i < outline.size; ++i)
            for (std::size_t k = 0; k < outline.size; ++k) {
                sag = (std::max)(sag, std::abs(dot(double3(outline.points[i].node.normal), place[k] - place[i])));
                size2 = (std::max)(size2, length2(place[k] - place[i]));
            }
        normal = unit_or_zero(normal);
        direction = unit_or_zero(direction);
        density = static_cast<F>(density * T(1.0 / double(outline.size)));
        const double pixel = pixels_.pixel_at(place[0]);
        const double curvature = size2 > 0 ? 2 * sag / size2 : 0;
        const double thickness = pixel / 50 + 2 * sag + (std::min)(4 * curvature * square(pixel), pixel / 2);
        for (std::size_t i = 1; i + 1 < outline.size; ++i) {
            const double area = outline.area(0, i, i + 1) * area_of(cell) * scale;
            if (!(area > 0))
                continue;
            const F flux = static_cast<F>(density * T(area));
            const bool is_seen = blocks_.add_triangle({place[0], place[i], place[i + 1]}, normal, direction, flux,
                                                      thickness, tile_.pieces, visitor());
            account_.book(flux, is_seen, true);
        }
    }

    [[nodiscard]] double area_of(const Cell& cell) const {
        return lattice_.area() * double(cell.step) * double(cell.step);
    }

    [[nodiscard]] double pixel_about(const std::array<const Node*, 4>& ends) const {
        for (const Node* const end : ends)
            if (end)
                return pixels_.pixel_at(double3(end->position));
        return 0;
    }

    [[nodiscard]] auto visitor() {
        return [this](std::uint32_t leaf, std::uint32_t block) { tile_.visits.push_back({leaf, block}); };
    }

    const Lattice& lattice_;
    const ReceiverPixels<V>& pixels_;
    const Brightness& brightness_;
    Nodes& nodes_;
    TilePieces<V, F>& tile_;
    SheetAccount& account_;
    PatchBlocks<V, F> blocks_;
    std::vector<CellOutline<V, F>> outlines_;
};

} // namespace nephroid::detail
