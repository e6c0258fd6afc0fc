// SPDX-License-Identifier: MIT
/// @file  Footprints that reach no further than the sheet that their photon lies on.
#pragma once

#include "nephroid/smoothing/second_order/field_options.hpp"
#include "nephroid/smoothing/second_order/sheet_cells.hpp"
#include "nephroid/smoothing/second_order/varying_shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace nephroid::detail {

/// Bounds the shapes of photons.
class BorderBounds {
public:
    explicit BorderBounds(const FieldOptions& options) : scale_(options.scale), least_(options.bounds.least_radius) {}

    /// By where the sheet ends within the domain, in the frame of the cell.
    ///
    /// @param away   to the photon from the middle of the cell
    /// @param steps  a step along the photon's axes in the cell's frame, by columns
    void by_sheet(VaryingShape& shape, const SheetCell& cell, Plane2 away, const PlaneMatrix& steps) const {
        if (!std::isfinite(cell.border_distance))
            return;
        const Plane2 n = cell.border_direction;
        if (!(inner(n, n) > 0)) {
            const double most = square(reach_to(cell.border_distance).most);
            const Principal2 principal(shape.value);
            shape.value = principal.with((std::min)(principal.larger, most), (std::min)(principal.smaller, most));
            return;
        }
        const Reach reach = reach_to(cell.border_distance - inner(n, away));
        shape.bound_along(n, reach.most,
                          {-reach.by_distance * inner(n, steps.first), -reach.by_distance * inner(n, steps.second)});
    }

    /// By the borders of the light's domain, in the photon's own frame.
    ///
    /// @param samples_by_place  how its samples change with the place
    /// @param aspect            of the domain: its length along the first sample over that along the second
    void by_domain(VaryingShape& shape, const std::array<double, 2>& sample, const PlaneMatrix& samples_by_place,
                   double aspect) const {
        const std::array<Plane2, 2> slopes{{{samples_by_place.first.x, samples_by_place.second.x},
                                            {samples_by_place.first.y, samples_by_place.second.y}}};
        const std::array<double, 2> steepness{std::sqrt(inner(slopes[0], slopes[0])),
                                              std::sqrt(inner(slopes[1], slopes[1]))};
        // Where the borders of the two samples do not meet at a right angle there is no corner: a disk's border is all
        // four sides of the square, and the one is that of the triangle that the sample lies in.
        const double lean = std::abs(inner(slopes[0], slopes[1])) / (steepness[0] * steepness[1]);
        const auto room = [&](std::size_t axis) { return (std::min)(sample[axis], 1 - sample[axis]); };
        const std::size_t nearest = room(0) * aspect < room(1) ? 0 : 1;
        for (const std::size_t axis : {nearest, 1 - nearest}) {
            if (axis != nearest && lean > 0.3)
                continue;
            for (const bool upper : {false, true}) {
                const double distance = (upper ? 1 - sample[axis] : sample[axis]) / steepness[axis];
                const Plane2 n = ((upper ? 1 : -1) / steepness[axis]) * slopes[axis];
                const Reach reach = reach_to(distance);
                shape.bound_along(n, reach.most, -reach.by_distance * n);
            }
        }
    }

private:
    /// How far a footprint may reach towards a border, and how that changes with the distance to it.
    struct Reach {
        double most, by_distance;
    };

    [[nodiscard]] Reach reach_to(double distance) const {
        const double unit_reach = std::sqrt(scale_);
        return distance > least_ ? Reach{unit_reach * distance, unit_reach} : Reach{unit_reach * least_, 0};
    }

    double scale_, least_;
};

} // namespace nephroid::detail
