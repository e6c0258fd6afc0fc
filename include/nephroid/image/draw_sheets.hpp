// SPDX-License-Identifier: MIT
/// @file  Draws a photon buffer onto a caustic map as sheets: patches between neighbouring photons, with exact areas.
///        What lies on no patch is drawn as ellipses.
///
/// Derivation: include/nephroid/README.md, "Photons on a grid".
#pragma once

#include "nephroid/image/draw_splats.hpp"
#include "nephroid/image/map_patch.hpp"
#include "nephroid/image/neighbour_tangents.hpp"
#include "nephroid/sheet/sheet_options.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace nephroid {

/// How a buffer's sheets are drawn onto a map.
struct MapSheets {
    Tessellation tessellation{.bend = 0.05, .density = 0.05, .max_quads = 16};
    double broken_smoothing = 2; ///< of the ellipses of photons on cells in which sheets end, > 0
};

/// What became of a buffer's light on a map.
struct MapAccount {
    Statistics light;         ///< with what became of photons that never landed: closes
    std::uint64_t cells = 0;  ///< drawn as patches
    std::uint64_t broken = 0; ///< photons at cells in which their sheet ends
    double broken_flux = 0;   ///< drawn as ellipses
};

namespace detail {

template <Vector3 V, Flux F, class C, class E>
class BufferSheets {
public:
    using T = scalar_t<V>;
    using End = NodeEnd<V, F>;

    BufferSheets(const PhotonBuffer<V, F>& buffer, CausticMap<V, F, C>& map, const MapSheets& how, E& executor)
        : buffer_(buffer), map_(map), how_(how), executor_(executor),
          tiles_(map.chart().columns(), map.chart().rows(), repeats(map.chart())) {}

    void draw(MapAccount& account) {
        const std::size_t rows = buffer_.grid().rows, columns = buffer_.grid().columns,
                          batch = (std::max)(std::size_t(1), cells_per_batch / columns);
        whole_.assign(rows * columns, 0);
        for (std::size_t first = 0; first + 1 < rows; first += batch) {
            rows_.assign((std::min)(batch, rows - 1 - first), {});
            changes_.assign(rows_.size() + 1, {});
            executor_(changes_.size(), [&](std::size_t row) { find_changes(first + row, changes_[row]); });
            executor_(rows_.size(), [&](std::size_t row) { make_row(first + row, row); });
            draw_rows(account);
        }
        broken_.assign(rows, {});
        executor_(rows, [&](std::size_t j) { find_broken(j, broken_[j]); });
        std::vector<Deposit<V, F, 2>> deposits;
        for (const TangentPhotons<V, F>& row : broken_)
            deposits.insert(deposits.end(), row.deposits.begin(), row.deposits.end());
        for (const auto& deposit : deposits)
            account.broken_flux += double(flux_traits<F>::power(deposit.flux));
        account.broken += deposits.size();
        account.light += draw_splats(deposits, map_, {.smoothing = how_.broken_smoothing}, executor_);
    }

private:
    static constexpr std::size_t cells_per_batch = std::size_t(1) << 14;

    using Corners = std::array<std::array<const End*, 2>, 2>;

    /// The corners of cell (i, j) with a signature; all null unless one sheet goes through them.
    [[nodiscard]] Corners whole_cell(std::size_t i, std::size_t j, std::uint32_t signature) const {
        Corners c{};
        for (std::size_t a = 0; a < 2; ++a)
            for (std::size_t b = 0; b < 2; ++b)
                if (c[a][b] = end_of<V, F>(buffer_.ends(i + a, j + b), signature); !c[a][b])
                    return {};
        const auto none = [] { return 0.0; };
        for (std::size_t k = 0; k < 2; ++k)
            if (!are_joined(*c[0][k], *c[1][k], none) || !are_joined(*c[k][0], *c[k][1], none))
                return {};
        return c;
    }

    /// How places change from node to node along a row of nodes, for all their ends.
    struct RowChanges {
        std::vector<std::array<Double3, 2>> of_ends;
        std::vector<std::size_t> first; ///< of each node
    };

    void find_changes(std::size_t j, RowChanges& row) const {
        for (std::size_t i = 0; i < buffer_.grid().columns; ++i) {
            row.first.push_back(row.of_ends.size());
            for (const End& end : buffer_.ends(i, j))
                row.of_ends.push_back(neighbour_changes(buffer_, i, j, end));
        }
    }

    /// The cells above a row of nodes. @param batch_row  in the batch
    void make_row(std::size_t j, std::size_t batch_row) {
        std::vector<MapPatch<V, F>>& row = rows_[batch_row];
        const T area = T(buffer_.step_u() * buffer_.step_v());
        for (std::size_t i = 0; i + 1 < buffer_.grid().columns; ++i)
            for (const End& end : buffer_.ends(i, j)) {
                const Corners c = whole_cell(i, j, end.signature);
                if (!c[0][0] || c[0][0] != &end)
                    continue;
                LitPatch<V, F> patch{};
                for (std::size_t a = 0; a < 2; ++a)
                    for (std::size_t b = 0; b < 2; ++b) {
                        const RowChanges& changes = changes_[batch_row + b];
                        const std::size_t of_node = std::size_t(c[a][b] - buffer_.ends(i + a, j + b).data());
                        const auto& change = changes.of_ends[changes.first[i + a] + of_node];
                        patch.corners[a][b] = {double3(c[a][b]->position), change[0], change[1]};
                        patch.normal[a][b] = double3(c[a][b]->normal);
                        patch.direction[a][b] = double3(c[a][b]->direction);
                    }
                patch.flux = static_cast<F>(
                    (c[0][0]->density + c[0][1]->density + (c[1][0]->density + c[1][1]->density)) * (T(0.25) * area));
                ++whole_[j * buffer_.grid().columns + i];
                row.push_back(map_patch(patch, how_.tessellation, map_.chart()));
                row.back().turn = i + j;
            }
    }

    void draw_rows(MapAccount& account) {
        patches_.clear();
        boxes_.clear();
        for (const auto& row : rows_)
            for (const MapPatch<V, F>& patch : row) {
                patches_.push_back(&patch);
                boxes_.push_back(patch.box);
            }
        const std::vector<char> arrived = tiles_.draw(
            boxes_, [&](std::size_t i, const RasterWindow& window) { return add_patch(*patches_[i], window); },
            executor_);
        for (std::size_t i = 0; i < patches_.size(); ++i)
            account.light.lose(arrived[i] ? Fate::splatted : Fate::unseen,
                               double(flux_traits<F>::power(patches_[i]->patch.flux)));
        account.cells += patches_.size();
    }

    [[nodiscard]] bool add_patch(const MapPatch<V, F>& patch, const RasterWindow& window) {
        thread_local PatchTexels texels;
        bool arrived = false;
        const ChartVector middle = patch.middle + step_between_tiles(map_.chart(), window.shift_x, window.shift_y);
        texels.cover(patch, window, map_.chart()).visit([&](std::size_t i, std::size_t j, double amount) {
            auto& texel = map_.texel(window.column + i, window.row + j);
            if (!(texel.scale > 0) || !CausticMap<V, F, C>::is_on(texel, middle, patch.normal, 2 * patch.sag))
                return;
            texel.irradiance = texel.irradiance + patch.patch.flux * T(amount);
            arrived = true;
        });
        return arrived;
    }

    /// The photons of a row that lie at cells in which their sheet ends, each with a quarter of such a cell's light.
    void find_broken(std::size_t j, TangentPhotons<V, F>& row) const {
        const std::size_t columns = buffer_.grid().columns, rows = buffer_.grid().rows;
        const double quarter = 0.25 * buffer_.step_u() * buffer_.step_v();
        for (std::size_t i = 0; i < columns; ++i) {
            if (is_inside_sheets(i, j))
                continue;
            for (const End& end : buffer_.ends(i, j)) {
                int broken = 0;
                for (std::size_t b = j > 0 ? 0 : 1; b < (j + 1 < rows ? 2u : 1u); ++b)
                    for (std::size_t a = i > 0 ? 0 : 1; a < (i + 1 < columns ? 2u : 1u); ++a) {
                        const Corners c = whole_cell(i + a - 1, j + b - 1, end.signature);
                        broken += int(c[1 - a][1 - b] != &end);
                    }
                if (broken > 0)
                    row.deposits.push_back({end.position, end.normal, end.direction,
                                            static_cast<F>(end.density * T(quarter * broken)),
                                            tangents_of(buffer_, i, j, end, row)});
            }
        }
    }

    /// Whether as many sheets as a node has ends go through each of the cells about it: those that its ends are on.
    [[nodiscard]] bool is_inside_sheets(std::size_t i, std::size_t j) const {
        const std::size_t columns = buffer_.grid().columns, rows = buffer_.grid().rows,
                          ends = buffer_.ends(i, j).size();
        for (std::size_t b = j > 0 ? 0 : 1; b < (j + 1 < rows ? 2u : 1u); ++b)
            for (std::size_t a = i > 0 ? 0 : 1; a < (i + 1 < columns ? 2u : 1u); ++a)
                if (whole_[(j + b - 1) * columns + i + a - 1] != ends)
                    return false;
        return true;
    }

    const PhotonBuffer<V, F>& buffer_;
    CausticMap<V, F, C>& map_;
    const MapSheets& how_;
    E& executor_;
    RasterTiles tiles_;
    std::vector<std::vector<MapPatch<V, F>>> rows_;
    std::vector<RowChanges> changes_;
    std::vector<const MapPatch<V, F>*> patches_;
    std::vector<RasterBox> boxes_;
    std::vector<std::uint32_t> whole_; ///< of each cell, by its first node: the sheets that go through it
    std::vector<TangentPhotons<V, F>> broken_;
};
} // namespace detail

/// Draws a buffer's sheets onto a map.
///
/// @param buffer    with its nodes at the corners of cells: between the outermost centres and the lamp's border there
///                  would be no sheet
/// @param executor  the map does not depend on it, bit for bit
/// Throws std::invalid_argument for a buffer of centres and for options that make no sense.
template <Vector3 V, Flux F, class C, class E = SerialExecutor>
MapAccount draw_sheets(const PhotonBuffer<V, F>& buffer, CausticMap<V, F, C>& map, const MapSheets& how = {},
                       E&& executor = E{}) {
    if (buffer.grid().nodes != NodePlaces::corners)
        invalid_argument("nephroid::draw_sheets: the buffer's nodes lie in the centres of cells; trace it with "
                         ".nodes = NodePlaces::corners");
    detail::check(SheetOptions{.tessellation = how.tessellation}, "nephroid::draw_sheets");
    detail::check(Rescaling{.smoothing = how.broken_smoothing});
    detail::CheckedExecutor checked(executor);
    MapAccount account{.light = buffer.account()};
    detail::BufferSheets<V, F, C, decltype(checked)>(buffer, map, how, checked).draw(account);
    return account;
}

} // namespace nephroid
