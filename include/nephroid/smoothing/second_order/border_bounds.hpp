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

    /// Bounds a shape by the border of the path group, which was found from photons, in the frame of the cell. It is
    /// bounded alike in all directions: where the border's direction turns from cell to cell, by errors or at corners,
    /// the long axes of footprints would turn with it, and their shifts follow that.
    ///
    /// @param away   from the middle of the cell to the photon
    /// @param steps  the photon's axes in the cell's frame, as columns
    void bound_by_group(VaryingShape& shape, const GroupCell& cell, Plane2 away, const PlaneMatrix& steps) const {
        if (!std::isfinite(cell.border_distance))
            return;
        bound_towards(shape, cell.border_direction, cell.border_distance, away, steps);
        if (std::isfinite(cell.across_distance))
            bound_towards(shape, cell.across_direction, cell.across_distance, away, steps);
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

    /// @param n         unit, towards a border, in the frame of the cell; 0 for one without a direction
    /// @param distance  of the border from the cell's middle
    void bound_towards(VaryingShape& shape, Plane2 n, double distance, Plane2 away, const PlaneMatrix& steps) const {
        const Reach reach = reach_to_found(distance - inner(n, away));
        shape.bound_size(reach.radius,
                         {-reach.by_distance * inner(n, steps.first), -reach.by_distance * inner(n, steps.second)});
    }

    [[nodiscard]] Reach reach_to(double distance) const {
        const double unit_reach = std::sqrt(scale_);
        return distance > least_ ? Reach{unit_reach * distance, unit_reach} : Reach{unit_reach * least_, 0};
    }

    /// The reach towards a border that was found from photons, to about a quarter of a cell. The shift follows how S
    /// grows with the distance d, and errors of the border with it. So S grows with l d, where the shift is the same
    /// for any d. l is twice the published radius, which has little noise. The border itself lies further inwards or
    /// outwards than it seems, and footprints there have half of the published radius.
    [[nodiscard]] Reach reach_to_found(double distance) const {
        constexpr double l = 2 * default_smoothing, least = 0.5 * default_smoothing;
        const double d = (std::max)(distance, 0.0), radius2 = std::sqrt(square(square(least)) + square(l * d));
        const double unit_reach = std::sqrt(scale_), radius = std::sqrt(radius2);
        return {unit_reach * radius, unit_reach * 0.5 * square(l) * d / (radius * radius2)};
    }

    double scale_, least_;
};

} // namespace nephroid::detail
