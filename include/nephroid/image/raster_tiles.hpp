// SPDX-License-Identifier: MIT
/// @file  Divides a raster into tiles, each drawn by one thread in the order of what is drawn: the same sums with any
///        number of threads, without atomics.
#pragma once

#include "nephroid/execution/executor.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nephroid::detail {

/// A rectangle of the raster, in texels; nothing to draw unless x0 <= x1 and y0 <= y1.
struct RasterBox {
    double x0 = 0, y0 = 0, x1 = -1, y1 = -1;

    void include(double x, double y) {
        const bool is_first = x0 > x1;
        x0 = is_first ? x : (std::min)(x0, x);
        y0 = is_first ? y : (std::min)(y0, y);
        x1 = is_first ? x : (std::max)(x1, x);
        y1 = is_first ? y : (std::max)(y1, y);
    }
};

/// A part of a tile, in whole texels, and by how much what is drawn is moved (on charts that repeat).
struct RasterWindow {
    std::size_t column, row, columns, rows;
    double shift_x, shift_y;
};

/// The window of a box on a part of the raster.
[[nodiscard]] inline RasterWindow window_of(const RasterBox& box, double shift_x, double shift_y, std::size_t column,
                                            std::size_t row, std::size_t end_column, std::size_t end_row) {
    const auto clamp = [](double x, std::size_t low, std::size_t high) {
        return std::size_t(std::clamp(std::floor(x), double(low), double(high)));
    };
    const std::size_t x0 = clamp(box.x0 + shift_x, column, end_column), y0 = clamp(box.y0 + shift_y, row, end_row);
    const std::size_t x1 = clamp(box.x1 + shift_x + 1, column, end_column),
                      y1 = clamp(box.y1 + shift_y + 1, row, end_row);
    return {x0, y0, x1 - x0, y1 - y0, shift_x, shift_y};
}

class RasterTiles {
public:
    RasterTiles(std::size_t columns, std::size_t rows, bool repeats)
        : columns_(columns), rows_(rows), across_((columns + side - 1) / side), repeats_(repeats),
          visits_(across_ * ((rows + side - 1) / side)) {}

    /// Draws things into all the tiles that their boxes overlap.
    ///
    /// @param draw  draw(number, window) -> whether any light arrived. Called from several threads, one for each tile
    /// @return  of each thing whether any of its light arrived
    template <class Draw, class E>
    [[nodiscard]] std::vector<char> draw(std::span<const RasterBox> boxes, const Draw& draw, E& executor) {
        for (auto& visits : visits_)
            visits.clear();
        for (std::size_t i = 0; i < boxes.size(); ++i)
            bin(std::uint32_t(i), boxes[i]);
        executor(visits_.size(), [&](std::size_t tile) {
            for (Visit& visit : visits_[tile])
                visit.arrived = draw(std::size_t(visit.number), window(tile, boxes[visit.number], visit));
        });
        std::vector<char> arrived(boxes.size(), 0);
        for (const auto& visits : visits_)
            for (const Visit& visit : visits)
                arrived[visit.number] |= char(visit.arrived);
        return arrived;
    }

private:
    static constexpr std::size_t side = 64;

    struct Visit {
        std::uint32_t number;
        std::int32_t repeat_x, repeat_y;
        bool arrived = false;
    };

    void bin(std::uint32_t number, const RasterBox& box) {
        const double w = double(columns_), h = double(rows_);
        const bool is_finite = std::isfinite(box.x0 + box.x1 + box.y0 + box.y1);
        // What spans a thousand tiles of a pattern is no longer light of one photon.
        if (!is_finite || !(box.x0 <= box.x1 && box.y0 <= box.y1) || (repeats_ && !spans_few(box)))
            return;
        const std::int32_t from_x = repeats_ ? std::int32_t(std::floor(box.x0 / w)) : 0,
                           to_x = repeats_ ? std::int32_t(std::floor(box.x1 / w)) : 0,
                           from_y = repeats_ ? std::int32_t(std::floor(box.y0 / h)) : 0,
                           to_y = repeats_ ? std::int32_t(std::floor(box.y1 / h)) : 0;
        for (std::int32_t y = from_y; y <= to_y; ++y)
            for (std::int32_t x = from_x; x <= to_x; ++x) {
                const RasterWindow all = window_of(box, -x * w, -y * h, 0, 0, columns_, rows_);
                if (all.columns == 0 || all.rows == 0)
                    continue;
                for (std::size_t j = all.row / side; j <= (all.row + all.rows - 1) / side; ++j)
                    for (std::size_t i = all.column / side; i <= (all.column + all.columns - 1) / side; ++i)
                        visits_[j * across_ + i].push_back({number, x, y});
            }
    }

    [[nodiscard]] bool spans_few(const RasterBox& box) const {
        return (std::max)(std::abs(box.x0), std::abs(box.x1)) < 1e6 * double(columns_) &&
               (std::max)(std::abs(box.y0), std::abs(box.y1)) < 1e6 * double(rows_) &&
               box.x1 - box.x0 < 1e3 * double(columns_) && box.y1 - box.y0 < 1e3 * double(rows_);
    }

    [[nodiscard]] RasterWindow window(std::size_t tile, const RasterBox& box, const Visit& visit) const {
        const std::size_t column = tile % across_ * side, row = tile / across_ * side;
        return window_of(box, -visit.repeat_x * double(columns_), -visit.repeat_y * double(rows_), column, row,
                         (std::min)(column + side, columns_), (std::min)(row + side, rows_));
    }

    std::size_t columns_, rows_, across_;
    bool repeats_;
    std::vector<std::vector<Visit>> visits_;
};

} // namespace nephroid::detail
