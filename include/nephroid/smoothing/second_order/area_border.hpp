// SPDX-License-Identifier: MIT
/// @file  The border of a path group in the domain of an area light.
#pragma once

#include "nephroid/smoothing/second_order/area_cells.hpp"

#include <cmath>
#include <optional>
#include <span>

namespace nephroid::detail {

/// A hyperplane in the domain, relative to the middle of a cell. Lengths are in cells.
struct AreaBorder {
    AreaSample outwards; ///< unit normal
    double distance;     ///< from the middle, along the normal

    /// The same plane relative to the middle of another cell.
    [[nodiscard]] AreaBorder seen_from(const AreaCells::CellCoordinates& here,
                                       const AreaCells::CellCoordinates& there) const {
        AreaBorder moved = *this;
        for (std::size_t axis = 0; axis < 4; ++axis)
            moved.distance -= outwards[axis] * (double(there[axis]) - double(here[axis]));
        return moved;
    }
};

/// The border of a path group in a cell or in one that touches it.
///
/// The border is estimated as if a plane separated the photons of the group from all others, and the photons were
/// uniform on both sides. Then the plane is perpendicular to the line between the two means, and the counts give its
/// distance.
///
/// @param is_in_group  is_in_group(i): whether photon i belongs to the group. The end of the domain counts as photons
///                     outside the group, except along coordinates with one or two cells
/// @return  nothing where all photons belong to the group, or where the two kinds are mixed
template <class IsInGroup>
[[nodiscard]] std::optional<AreaBorder> border_near(const AreaCells& cells, std::size_t cell,
                                                    const std::vector<AreaSample>& samples,
                                                    const IsInGroup& is_in_group) {
    struct Side {
        AreaSample sum{};
        double count = 0;
        void add(const AreaSample& at, double weight) {
            for (std::size_t axis = 0; axis < 4; ++axis)
                sum[axis] += weight * at[axis];
            count += weight;
        }
    };
    Side inside, outside;
    cells.for_each_around(cell, [&](const std::array<int, 4>& step, std::size_t other) {
        if (other < cells.size()) {
            for (const std::uint32_t i : cells.photons(other))
                (is_in_group(i) ? inside : outside).add(cells.from_middle(cell, samples[i], true), 1);
            return;
        }
        AreaSample beyond{};
        const auto here = cells.coordinates_of(cell);
        for (std::size_t axis = 0; axis < 4; ++axis) {
            const bool ends = here[axis] + std::size_t(step[axis]) >= cells.counts()[axis];
            if (ends && !cells.is_fine(axis))
                return;
            beyond[axis] = cells.is_fine(axis) ? step[axis] : 0;
        }
        outside.add(beyond, double(AreaCells::photons_per_cell));
    });
    if (!(inside.count > 0) || !(outside.count > 0))
        return std::nullopt;
    AreaBorder border{};
    double norm2 = 0;
    for (std::size_t axis = 0; axis < 4; ++axis) {
        border.outwards[axis] = outside.sum[axis] / outside.count - inside.sum[axis] / inside.count;
        norm2 += border.outwards[axis] * border.outwards[axis];
    }
    constexpr double width = 3; // of the cells examined; a plane through their middle puts the means half of it apart
    if (!(norm2 > 0.25))
        return std::nullopt;
    for (double& x : border.outwards)
        x /= std::sqrt(norm2);
    border.distance = width * (0.5 - outside.count / (inside.count + outside.count));
    return border;
}

} // namespace nephroid::detail
