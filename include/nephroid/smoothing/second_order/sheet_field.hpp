// SPDX-License-Identifier: MIT
/// @file  What the photons of one sheet say of one another: shapes of footprints and derivatives over a light's domain.
#pragma once

#include "nephroid/smoothing/second_order/border_bounds.hpp"
#include "nephroid/smoothing/second_order/emission_sheets.hpp"
#include "nephroid/smoothing/second_order/field_options.hpp"
#include "nephroid/smoothing/second_order/sheet_border.hpp"
#include "nephroid/smoothing/second_order/sheet_cells.hpp"
#include "nephroid/smoothing/second_order/sheet_fit.hpp"
#include "nephroid/smoothing/second_order/sheet_metric.hpp"
#include "nephroid/smoothing/second_order/smoothing_rule.hpp"
#include "nephroid/smoothing/second_order/varying_shape.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace nephroid::detail {

/// Shapes of footprints and second derivatives over one sheet, on a grid of cells.
class SheetField {
public:
    /// @param all     photons of the light, emitted with smoothing 1, whose samples are two numbers
    /// @param sheets  theirs
    /// @param sheet   one of those
    /// @param run     runs the fits; the field does not depend on it
    SheetField(const PathSamples& all, const EmissionSheets& sheets, const EmissionSheet& sheet,
               const FieldOptions& options, const TaskRunner& run)
        : options_(options), density_{options.stratified, sheet.share}, aspect_(sheets.aspect()), bounds_(options),
          cells_(EmissionCells(places_of(all, sheet), sheets.aspect(), options.repeats,
                               photons_per_cell(options.stratified, sheet.share) * double(sheet.photons.size()) /
                                   (double(all.size()) * sheet.share))) {
        PathSamples photons;
        for (const std::uint32_t i : sheet.photons)
            photons.add(all[i]);
        const auto for_each_cell = [&](const auto& work) {
            for_each_index(run, cells_.size(), 32, [&](std::size_t i) { work(cells_[i]); });
        };
        for_each_cell([&](SheetCell& cell) {
            choose_frame(cell, cells_, photons);
            for (const std::uint32_t i : cells_.grid().photons(cell.square))
                cell.is_next_to_border = cell.is_next_to_border || sheets.is_next_to_border(sheet.photons[i]);
        });
        for_each_cell([&](SheetCell& cell) {
            if (cell.has_frame)
                fit_derivatives(cell, cells_, photons, options_, density_.share);
        });
        if (options_.smoothing) {
            for (std::size_t i = 0; i < cells_.size(); ++i)
                cells_[i].shape = Symmetric2::isotropic(square(*options_.smoothing));
            return;
        }
        find_borders(cells_, photons, options_.bounds.largest_radius);
        for_each_cell([&](SheetCell& cell) { choose_shape(cell); });
    }

    /// Nothing where the photons say nothing: there are too few of them.
    [[nodiscard]] std::optional<FieldSample> at(const std::array<double, 2>& sample, const EmissionFrame& frame) const {
        const SheetCell* here = cells_.cell_in(cells_.grid().cell_of(sample));
        if (here == nullptr || !here->is_resolved)
            return std::nullopt;
        FieldSample result{};
        VaryingShape shape;
        const PlaneMatrix& metric = here->metric_by_side[side_of(sample)];
        const PlaneMatrix samples_by_place = (frame.axes_of(here->frame) * metric).inverse();
        for (const SheetNode& node : cells_.nodes_about(sample)) {
            const SheetCell* there = cells_.cell_in(node.square);
            const SheetCell& cell = there != nullptr && there->is_resolved ? *there : *here;
            // Tensors turn with the axes that they are by.
            const PlaneMatrix axes = frame.axes_of(cell.frame), back = cell.frame.axes_of(frame);
            const VaryingShape of_cell = shape_in(cell, sample, back).turned(axes);
            shape.add(node.weight, of_cell);
            const Plane2 slope{node.slope[0], node.slope[1]};
            shape.along_u += inner(slope, samples_by_place.first) * of_cell.value;
            shape.along_v += inner(slope, samples_by_place.second) * of_cell.value;
            const auto second = turned(cell.map.second, back);
            for (std::size_t i = 0; i < second.size(); ++i)
                result.second[i] += node.weight * second[i];
        }
        if (!options_.smoothing && !cells_.grid().repeats())
            bounds_.by_domain(shape, sample, samples_by_place, aspect_);
        result.shape = shape.value;
        result.divergence = {shape.along_u.xx + shape.along_v.xy, shape.along_u.xy + shape.along_v.yy};
        return result;
    }

private:
    [[nodiscard]] static std::vector<std::array<double, 2>> places_of(const PathSamples& all,
                                                                      const EmissionSheet& sheet) {
        std::vector<std::array<double, 2>> places;
        places.reserve(sheet.photons.size());
        for (const std::uint32_t i : sheet.photons)
            places.push_back(all[i].sample.at);
        return places;
    }

    /// By what the cells about it say together of how the map bends.
    void choose_shape(SheetCell& cell) const {
        if (!cell.is_resolved)
            return;
        double weights = 0;
        Symmetric2 blurred{};
        cells_.for_each_around(cell, [&](const SheetCell& other, double weight) {
            if (!other.is_resolved)
                return;
            blurred += weight * congruent(cell.frame.axes_of(other.frame), other.log_q);
            weights += weight;
        });
        cell.shape = options_.scale * smoothing_tensor((1 / weights) * blurred, density_, options_.bounds);
    }

    /// A cell's shape where a photon is, in the cell's frame: no wider than the sheet.
    ///
    /// @param steps  a step along the photon's axes in the cell's frame, by columns
    [[nodiscard]] VaryingShape shape_in(const SheetCell& cell, const std::array<double, 2>& sample,
                                        const PlaneMatrix& steps) const {
        VaryingShape shape{cell.shape, {}, {}};
        if (!options_.smoothing) {
            const EmissionCells& grid = cells_.grid();
            bounds_.by_sheet(shape, cell, cell.metric(grid.step_between(grid.middle(cell.square), sample)), steps);
        }
        return shape;
    }

    FieldOptions options_;
    PhotonDensity density_;
    double aspect_; // of the domain: its length along the first sample over that along the second
    BorderBounds bounds_;
    SheetCells cells_;
};

} // namespace nephroid::detail
