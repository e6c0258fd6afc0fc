// SPDX-License-Identifier: MIT
/// @file  A field of footprints over one path group, fitted to the photons of the group.
#pragma once

#include "nephroid/execution/task_runner.hpp"
#include "nephroid/pass/photon_pass.hpp"
#include "nephroid/smoothing/second_order/border_bounds.hpp"
#include "nephroid/smoothing/second_order/field_options.hpp"
#include "nephroid/smoothing/second_order/group_borders.hpp"
#include "nephroid/smoothing/second_order/group_cells.hpp"
#include "nephroid/smoothing/second_order/group_fit.hpp"
#include "nephroid/smoothing/second_order/group_frames.hpp"
#include "nephroid/smoothing/second_order/path_groups.hpp"
#include "nephroid/smoothing/second_order/smoothing_rule.hpp"
#include "nephroid/smoothing/second_order/tangent_scatter.hpp"
#include "nephroid/smoothing/second_order/varying_shape.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace nephroid::detail {

/// Shapes of footprints and second derivatives of the map over one path group, on a grid of cells.
class GroupField {
public:
    /// @param all     photons of the light, emitted with smoothing 1, with two emission coordinates
    /// @param groups  of these photons
    /// @param group   one of the groups
    /// @param run     runs the fits; the field does not depend on it
    GroupField(const PathSamples& all, const PathGroups& groups, const PathGroup& group, const FieldOptions& options,
               const TaskRunner& run)
        : options_(options), density_{options.stratified, group.share}, aspect_(groups.aspect()), bounds_(options),
          cells_(EmissionCells(coordinates_of(all, group), groups.aspect(), options.repeats,
                               photons_per_cell(options.stratified, group.share) * double(group.photons.size()) /
                                   (double(all.size()) * group.share))) {
        PathSamples photons;
        for (const std::uint32_t i : group.photons)
            photons.add(all[i]);
        const auto for_each_cell = [&](const auto& work) {
            for_each_index(run, cells_.size(), 32, [&](std::size_t i) { work(cells_[i]); });
        };
        for_each_cell([&](GroupCell& cell) {
            choose_frame(cell, cells_, photons);
            for (const std::uint32_t i : cells_.grid().photons(cell.square))
                cell.has_border = cell.has_border || groups.is_next_to_border(group.photons[i]);
        });
        for_each_cell([&](GroupCell& cell) {
            if (cell.has_frame)
                fit_derivatives(cell, cells_, photons, options_, density_.share);
        });
        if (options_.smoothing) {
            for (std::size_t i = 0; i < cells_.size(); ++i)
                cells_[i].shape = Symmetric2::isotropic(square(*options_.smoothing));
            return;
        }
        find_borders(cells_, photons);
        find_borders_across(cells_);
        spread_kinks(run);
        for_each_cell([&](GroupCell& cell) { choose_shape(cell); });
        is_contradicted_ = !options_.repeats && are_shapes_contradicted(); // a floor that repeats has jumps of its own
    }

    /// @return  nothing where too few photons determine the field
    [[nodiscard]] std::optional<FieldSample> at(const std::array<double, 2>& sample, const EmissionFrame& frame) const {
        if (is_contradicted_)
            return FieldSample{.shape = Symmetric2::isotropic(square(default_smoothing)),
                               .divergence = {},
                               .second = {},
                               .as_published = true};
        const GroupCell* here = cells_.cell_in(cells_.grid().cell_of(sample));
        if (here == nullptr || !here->is_resolved)
            return std::nullopt;
        FieldSample result{};
        VaryingShape shape;
        const PlaneMatrix& to_frame = here->to_frame_by_side[side_of(sample)];
        const PlaneMatrix samples_by_step = (frame.axes_of(here->frame) * to_frame).inverse();
        for (const InterpolationNode& node : cells_.nodes_around(sample)) {
            const GroupCell* there = cells_.cell_in(node.square);
            const GroupCell& cell = there != nullptr && there->is_resolved ? *there : *here;
            // Tensors are converted from the cell's axes to the photon's.
            const PlaneMatrix axes = frame.axes_of(cell.frame), back = cell.frame.axes_of(frame);
            const VaryingShape of_cell = shape_in(cell, sample, back).rotated(axes);
            shape.add(node.weight, of_cell);
            const Plane2 slope{node.slope[0], node.slope[1]};
            shape.along_u += inner(slope, samples_by_step.first) * of_cell.value;
            shape.along_v += inner(slope, samples_by_step.second) * of_cell.value;
            const auto second = rotated(cell.map.second, back);
            for (std::size_t i = 0; i < second.size(); ++i)
                result.second[i] += node.weight * second[i];
        }
        if (!options_.smoothing && !cells_.grid().repeats())
            bounds_.bound_by_domain(shape, sample, samples_by_step, aspect_);
        result.shape = shape.value;
        result.divergence = {shape.along_u.xx + shape.along_v.xy, shape.along_u.xy + shape.along_v.yy};
        return result;
    }

private:
    /// Whether photons contradict the map in many cells, and the footprints there have more area than the published
    /// ones; footprints with less do no more harm than those. Then no footprint of the group is trusted, since those
    /// of other cells reach into these.
    ///
    /// A quarter of the cells are many, and more where there are few cells: each then spans so much of a smooth map
    /// that photons contradict its fit as well, in up to 3 cells of 7. On flat facets they do so in half of the cells
    /// or nearly all.
    [[nodiscard]] bool are_shapes_contradicted() const {
        constexpr double published = square(square(default_smoothing)); // det S
        std::size_t resolved = 0, contradicted = 0;
        for (std::size_t i = 0; i < cells_.size(); ++i)
            if (cells_[i].is_resolved) {
                ++resolved;
                contradicted += cells_[i].is_contradicted && cells_[i].shape.determinant() > published;
            }
        const auto cells = double(resolved);
        return double(contradicted) > 0.25 * cells + 0.6 * std::sqrt(cells);
    }

    [[nodiscard]] static std::vector<std::array<double, 2>> coordinates_of(const PathSamples& all,
                                                                           const PathGroup& group) {
        std::vector<std::array<double, 2>> coordinates;
        coordinates.reserve(group.photons.size());
        for (const std::uint32_t i : group.photons)
            coordinates.push_back(all[i].sample.at);
        return coordinates;
    }

    /// Blurs the kinks over a few cells, as far as a footprint reaches. If footprints narrowed within one cell, their
    /// shift would follow that change, and draw streaks along the edges of a mesh.
    void spread_kinks(const TaskRunner& run) {
        constexpr int passes = 4;
        std::vector<MapKinks> blurred(cells_.size());
        for (int pass = 0; pass < passes; ++pass) {
            for_each_index(run, cells_.size(), 256, [&](std::size_t i) {
                blurred[i] = {};
                cells_.for_each_around(
                    cells_[i], [&](const GroupCell& other, double weight) { blurred[i].add(other.kinks, weight); });
            });
            for (std::size_t i = 0; i < cells_.size(); ++i)
                cells_[i].kinks = blurred[i];
        }
    }

    /// Chooses the shape from how much the map bends, averaged over the cells around.
    void choose_shape(GroupCell& cell) const {
        if (!cell.is_resolved)
            return;
        double weights = 0, scatter = 0;
        Symmetric2 blurred{};
        MapKinks kinks;
        cells_.for_each_around(cell, [&](const GroupCell& other, double weight) {
            if (!other.is_resolved)
                return;
            blurred += weight * congruent(cell.frame.axes_of(other.frame), other.log_q);
            kinks.add(other.kinks, weight);
            scatter += weight * other.scatter;
            weights += weight;
        });
        const Symmetric2 shape = shape_tensor((1 / weights) * blurred, density_, options_.bounds, kinks.density());
        cell.shape = bounded_by_scatter(options_.scale * shape, scatter / weights, options_.bounds.least);
    }

    /// A cell's shape at a photon, in the cell's frame, bounded by the border of the group.
    ///
    /// @param steps  the photon's axes in the cell's frame, as columns
    [[nodiscard]] VaryingShape shape_in(const GroupCell& cell, const std::array<double, 2>& sample,
                                        const PlaneMatrix& steps) const {
        VaryingShape shape{cell.shape, {}, {}};
        if (!options_.smoothing) {
            const EmissionCells& grid = cells_.grid();
            bounds_.bound_by_group(shape, cell, cell.to_frame(grid.step_between(grid.middle(cell.square), sample)),
                                   steps);
        }
        return shape;
    }

    FieldOptions options_;
    PhotonDensity density_;
    double aspect_; // of the domain: its length along the first coordinate over that along the second
    BorderBounds bounds_;
    GroupCells cells_;
    bool is_contradicted_ = false; // then all photons are splatted as published
};

} // namespace nephroid::detail
