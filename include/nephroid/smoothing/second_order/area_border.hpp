// SPDX-License-Identifier: MIT
/// @file  Where a sheet of the map from an area light ends: at photons that took another path.
#pragma once

#include "nephroid/smoothing/second_order/area_cells.hpp"

#include <cmath>
#include <optional>
#include <span>

namespace nephroid::detail {

/// A plane in the domain of samples, seen from the middle of a cell; lengths in cells.
struct AreaBorder {
    AreaSample outwards; ///< unit
    double ahead;        ///< distance from the middle

    /// The same, seen from the middle of another cell.
    [[nodiscard]] AreaBorder seen_from(const AreaCells::Place& here, const AreaCells::Place& there) const {
        AreaBorder moved = *this;
        for (std::size_t axis = 0; axis < 4; ++axis)
            moved.ahead -= outwards[axis] * (double(there[axis]) - double(here[axis]));
        return moved;
    }
};

/// The border that passes a cell or one that touches it, if any does. Were the photons that are on the sheet and those
/// that are not parted by a plane, and even on both sides of it, then it would lie across the line between their means,
/// and as far ahead as their numbers say.
///
/// @param is_on  is_on(i): whether photon i is on the sheet. The domain ends like the sheet does, but not along numbers
///               that are split in two at most
/// @return  nothing where all are on the sheet, or where those that are not lie amid the others
template <class IsOn>
[[nodiscard]] std::optional<AreaBorder> border_about(const AreaCells& cells, std::size_t cell,
                                                     std::span<const AreaSample> samples, const IsOn& is_on) {
    struct Side {
        AreaSample sum{};
        double count = 0;
        void add(const AreaSample& at, double weight) {
            for (std::size_t axis = 0; axis < 4; ++axis)
                sum[axis] += weight * at[axis];
            count += weight;
        }
    };
    Side on, off;
    cells.for_each_around(cell, [&](const std::array<int, 4>& step, std::size_t other) {
        if (other < cells.size()) {
            for (const std::uint32_t i : cells.photons(other))
                (is_on(i) ? on : off).add(cells.from_middle(cell, samples[i], true), 1);
            return;
        }
        AreaSample beyond{};
        const auto place = cells.place_of(cell);
        for (std::size_t axis = 0; axis < 4; ++axis) {
            const bool ends = place[axis] + std::size_t(step[axis]) >= cells.counts()[axis];
            if (ends && !cells.is_fine(axis))
                return;
            beyond[axis] = cells.is_fine(axis) ? step[axis] : 0;
        }
        off.add(beyond, double(AreaCells::photons_per_cell));
    });
    if (!(on.count > 0) || !(off.count > 0))
        return std::nullopt;
    AreaBorder border{};
    double norm2 = 0;
    for (std::size_t axis = 0; axis < 4; ++axis) {
        border.outwards[axis] = off.sum[axis] / off.count - on.sum[axis] / on.count;
        norm2 += border.outwards[axis] * border.outwards[axis];
    }
    constexpr double width = 3; // of the cells looked at; a plane across them has the means half of that apart
    if (!(norm2 > 0.25))
        return std::nullopt;
    for (double& x : border.outwards)
        x /= std::sqrt(norm2);
    border.ahead = width * (0.5 - off.count / (on.count + off.count));
    return border;
}

} // namespace nephroid::detail
