// SPDX-License-Identifier: MIT
/// @file  Shapes of footprints and second derivatives over the four-dimensional domain of an area light, from its
///        photons.
///
/// A footprint follows a slice of that domain. Two vectors span the slice, and each changes position and direction at
/// once (aligned_basis.hpp). Along the slice the shift is the same as in two dimensions [include/nephroid/README.md,
/// "Lamps with area"]. It needs only how the tangents change along themselves, and neighbours show that: J(u) is fitted
/// linearly in all four coordinates, and quadratically along the slice.
///
/// Borders matter less than in two dimensions, because light from the whole lamp falls on both sides of them, and short
/// footprints beside them show single photons sooner.
#pragma once

#include "nephroid/execution/task_runner.hpp"
#include "nephroid/smoothing/second_order/area_border_search.hpp"
#include "nephroid/smoothing/second_order/area_cell_fit.hpp"
#include "nephroid/smoothing/second_order/area_grid.hpp"
#include "nephroid/smoothing/second_order/area_photons.hpp"
#include "nephroid/smoothing/second_order/field_options.hpp"
#include "nephroid/smoothing/second_order/smoothing_rule.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>

namespace nephroid::detail {

/// As FootprintField, for lights with four emission coordinates.
class AreaField {
public:
    /// @param photons   of one light, emitted with smoothing 1, with four emission coordinates: a random-access range
    ///                  of TracedPhoton
    /// @param executor  runs the fits; the field does not depend on it
    template <class Photons, class E>
    AreaField(const Photons& photons, const FieldOptions& options, E& executor)
        : AreaField(AreaPhotons(PathSamples(photons)), options, TaskRunner(executor)) {}

    /// @return  nothing where the cell's photons are too few, or most of them took another path
    [[nodiscard]] std::optional<FieldSample> at(const EmissionSample& drawn, const EmissionFrame& frame,
                                                std::uint32_t signature) const {
        const AreaSample sample = area_sample(drawn);
        const std::size_t here = area_.grid.cell_of(sample);
        const AreaCell& cell_here = area_.cells[here];
        if (!cell_here.is_resolved || cell_here.signature != signature || !frame.is_of_area())
            return std::nullopt;
        FieldSample result{};
        std::array<Symmetric2, 4> by_sample; // ∂S by each emission coordinate
        area_.grid.for_each_node(sample, [&](std::size_t node, double weight, const AreaSample& slope) {
            const AreaCell& cell = area_.cells[area_.are_linked(here, node) ? node : here];
            const PlaneMatrix rotation = cell.frame.rotation_of(frame);
            const Symmetric2 shape = congruent(rotation.transposed(), cell.shape);
            result.shape += weight * shape;
            for (std::size_t axis = 0; axis < 4; ++axis)
                by_sample[axis] += slope[axis] * shape;
            const auto second = rotated(cell.map.second, rotation);
            for (std::size_t i = 0; i < second.size(); ++i)
                result.second[i] += weight * second[i];
        });
        const auto along = [&](Plane2 tangent) {
            Symmetric2 d;
            for (std::size_t axis = 0; axis < 4; ++axis)
                d += inner(cell_here.samples_by_step[axis], tangent) * by_sample[axis];
            return d;
        };
        const PlaneMatrix rotation = cell_here.frame.rotation_of(frame);
        const Symmetric2 du = along(rotation.first), dv = along(rotation.second);
        result.divergence = {du.xx + dv.xy, du.xy + dv.yy};
        return result;
    }

    [[nodiscard]] const AreaCells& cells() const { return area_.grid; }

private:
    AreaField(const AreaPhotons& photons, const FieldOptions& options, const TaskRunner& run)
        : options_(options), area_(AreaCells(photons.samples(), photons.cell_counts())) {
        const auto for_each_cell = [&](const auto& work) {
            for_each_index(run, area_.cells.size(), 32, [&](std::size_t i) { work(area_.cells[i], i); });
        };
        const AreaCells& grid = area_.grid;
        for_each_cell([&](AreaCell& cell, std::size_t index) { choose_frame(cell, index, grid, photons); });
        for_each_cell([&](AreaCell& cell, std::size_t i) { fit_derivatives(cell, i, grid, photons, options_); });
        if (options_.smoothing) {
            for (AreaCell& cell : area_.cells)
                cell.shape = Symmetric2::isotropic(square(*options_.smoothing));
        } else {
            const double reach = options_.bounds.largest_radius;
            for_each_cell([&](AreaCell& cell, std::size_t i) { find_border(cell, i, grid, photons, reach); });
            propagate_borders(area_, reach);
            for_each_cell([&](AreaCell& cell, std::size_t index) { choose_shape(cell, index); });
        }
    }

    /// Chooses the shape from how much the map bends, averaged over the cells around.
    void choose_shape(AreaCell& cell, std::size_t index) const {
        if (!cell.is_resolved)
            return;
        double weights = 0;
        Symmetric2 blurred{};
        area_.grid.for_each_around(index, [&](const std::array<int, 4>& step, std::size_t other) {
            if (other == area_.grid.size() || !area_.are_linked(index, other))
                return;
            double weight = 1; // of a (1 2 1) blur along each axis
            for (const int s : step)
                weight *= 2 - std::abs(s);
            const AreaCell& around = area_.cells[other];
            blurred += weight * congruent(cell.frame.rotation_of(around.frame), around.log_q);
            weights += weight;
        });
        Symmetric2 shape = area_shape_tensor((1 / weights) * blurred, options_.stratified, options_.bounds);
        if (std::isfinite(cell.border_distance))
            shape =
                bounded_along(shape, cell.border_direction, (std::max)(least_border_radius, 2 * cell.border_distance));
        cell.shape = options_.scale * shape;
    }

    static constexpr double least_border_radius = 8; ///< in u0: shorter radii beside a border would show noise

    FieldOptions options_;
    AreaGrid area_;
};

} // namespace nephroid::detail
