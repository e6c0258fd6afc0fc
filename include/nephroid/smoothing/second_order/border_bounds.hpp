// SPDX-License-Identifier: MIT
/// @file  Limits footprints to the borders of their path group and of the light's domain.
#pragma once

#include "nephroid/pass/photon_pass.hpp"
#include "nephroid/smoothing/second_order/field_options.hpp"
#include "nephroid/smoothing/second_order/group_cells.hpp"
#include "nephroid/smoothing/second_order/varying_shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace nephroid::detail {

/// Bounds the shapes of footprints beside borders.
class BorderBounds {
public:
    explicit BorderBounds(const FieldOptions& options) : scale_(options.scale), least_(options.bounds.least_radius) {}

    /// Bounds a shape by the border of the path group, in the frame of the cell.
    ///
    /// @param side   of the cell, in u0
    /// @param away   from the middle of the cell to the photon
    /// @param steps  the photon's axes in the cell's frame, as columns
    void bound_by_group(VaryingShape& shape, const GroupCell& cell, double side, Plane2 away,
                        const PlaneMatrix& steps) const {
        if (!std::isfinite(cell.border_distance))
            return;
        const Plane2 n = cell.border_direction;
        if (!(inner(n, n) > 0)) {
            const double radius2 = square(reach_to_found(cell.border_distance, side).radius);
            const Principal2 principal(shape.value);
            shape.value = principal.with((std::min)(principal.larger, radius2), (std::min)(principal.smaller, radius2));
            return;
        }
        bound_towards(shape, n, cell.border_distance, side, away, steps);
        if (std::isfinite(cell.across_distance))
            bound_towards(shape, cell.across_direction, cell.across_distance, side, away, steps);
    }

    /// Bounds a shape by the borders of the light's domain, in the photon's own frame.
    ///
    /// @param sample             emission coordinates of the photon, 0 to 1
    /// @param samples_by_step    derivatives of the emission coordinates by a step in the frame
    /// @param aspect             of the domain: its length along the first coordinate over that along the second
    void bound_by_domain(VaryingShape& shape, const std::array<double, 2>& sample, const PlaneMatrix& samples_by_step,
                         double aspect) const {
        const std::array<Plane2, 2> gradients{
            {{samples_by_step.first.x, samples_by_step.second.x}, {samples_by_step.first.y, samples_by_step.second.y}}};
        const std::array<double, 2> norms{std::sqrt(inner(gradients[0], gradients[0])),
                                          std::sqrt(inner(gradients[1], gradients[1]))};
        // The borders of a rectangular domain meet at right angles, and each one bounds the footprint. A disk's border
        // has no corners: all four sides of the square map onto it, and the nearest side bounds the footprint alone.
        const double cosine = std::abs(inner(gradients[0], gradients[1])) / (norms[0] * norms[1]);
        const auto to_border = [&](std::size_t axis) { return (std::min)(sample[axis], 1 - sample[axis]); };
        const std::size_t nearest = to_border(0) * aspect < to_border(1) ? 0 : 1;
        for (const std::size_t axis : {nearest, 1 - nearest}) {
            if (axis != nearest && cosine > 0.3)
                continue;
            for (const bool upper : {false, true}) {
                const double distance = (upper ? 1 - sample[axis] : sample[axis]) / norms[axis];
                const Plane2 n = ((upper ? 1 : -1) / norms[axis]) * gradients[axis];
                const Reach reach = reach_to(distance);
                shape.bound_along(n, reach.radius, -reach.by_distance * n);
            }
        }
    }

private:
    /// The largest radius towards a border, and its derivative by the distance to the border.
    struct Reach {
        double radius, by_distance;
    };

    /// @param n         unit, towards a border, in the frame of the cell
    /// @param distance  of the border from the cell's middle
    /// @param side      of the cell
    void bound_towards(VaryingShape& shape, Plane2 n, double distance, double side, Plane2 away,
                       const PlaneMatrix& steps) const {
        const Reach reach = reach_to_found(distance - inner(n, away), side);
        shape.bound_along(n, reach.radius,
                          {-reach.by_distance * inner(n, steps.first), -reach.by_distance * inner(n, steps.second)});
    }

    [[nodiscard]] Reach reach_to(double distance) const {
        const double unit_reach = std::sqrt(scale_);
        return distance > least_ ? Reach{unit_reach * distance, unit_reach} : Reach{unit_reach * least_, 0};
    }

    /// The reach towards a border that was found from photons, to about a quarter of a cell's side h. The shift follows
    /// how footprints grow with the distance d, and so it follows errors of the border too. If they reached as far as
    /// the border everywhere, light would vary by d/(32 h) where it should be even. So S grows with d² up to a
    /// distance l only, and with l d further away, where light then varies by l/(64 h). Twice the published radius has
    /// little noise; where cells are larger, as in passes of more photons than the pilot, l is a cell's side.
    [[nodiscard]] Reach reach_to_found(double distance, double side) const {
        if (!(distance > least_))
            return reach_to(distance);
        const double l = (std::max)(2 * default_smoothing, side);
        const double near2 = 1 / square(distance), far2 = 1 / square(l); // 1/r⁴ = 1/d⁴ + 1/(l d)²
        const double radius2 = 1 / std::sqrt(near2 * (near2 + far2)), radius = std::sqrt(radius2);
        const double by_distance = radius * radius2 * radius2 * near2 / distance * (near2 + 0.5 * far2);
        const double unit_reach = std::sqrt(scale_);
        return {unit_reach * radius, unit_reach * by_distance};
    }

    double scale_, least_;
};

} // namespace nephroid::detail
