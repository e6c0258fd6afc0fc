// SPDX-License-Identifier: MIT
/// @file  Shapes of footprints and second derivatives over the four-dimensional domain of an area light, from its
///        photons.
///
/// A footprint follows a slice of that domain, spanned by two vectors that change place and direction at once
/// (aligned_basis.hpp). Along it the shift is the same as in two dimensions [include/nephroid/README.md, "Lamps with
/// area"]. It needs the change of the tangents along themselves only, which neighbours tell: J(u) is fitted linearly in
/// all four coordinates, and quadratically along the slice.
///
/// Borders count for less than in two dimensions, since light from all places of the lamp falls on either side, and
/// short footprints beside them show photons sooner.
#pragma once

#include "nephroid/execution/executor.hpp"
#include "nephroid/smoothing/second_order/area_border.hpp"
#include "nephroid/smoothing/second_order/area_fit.hpp"
#include "nephroid/smoothing/second_order/area_photons.hpp"
#include "nephroid/smoothing/second_order/bending.hpp"
#include "nephroid/smoothing/second_order/footprint_field.hpp"
#include "nephroid/smoothing/second_order/smoothing_rule.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace nephroid::detail {

/// As FootprintField, for lights that draw four numbers.
class AreaField {
public:
    /// @param photons   of one light, emitted with smoothing 1, whose samples are four numbers: a random-access range
    ///                  of TracedPhoton
    /// @param executor  runs the fits; the field does not depend on it
    template <class Photons, class E>
    AreaField(const Photons& photons, const FieldOptions& options, E& executor)
        : AreaField(AreaPhotons(PathSamples(photons)), options, run_by(executor)) {}

    /// Nothing where the photons say nothing: too few of them, or none that took the same path.
    [[nodiscard]] std::optional<FieldSample> at(const EmissionSample& drawn, const EmissionFrame& frame,
                                                std::uint32_t signature) const {
        const AreaSample sample = area_sample(drawn);
        const std::size_t here = grid_.cell_of(sample);
        if (!cells_[here].is_resolved || cells_[here].signature != signature || !frame.is_of_area())
            return std::nullopt;
        FieldSample result{};
        std::array<Symmetric2, 4> by_sample; // ∂S
        grid_.for_each_node(sample, [&](std::size_t node, double weight, const AreaSample& slope) {
            const Cell& cell = cells_[are_linked(here, node) ? node : here];
            const PlaneMatrix turn = cell.frame.turn_of(frame);
            const Symmetric2 shape = congruent(turn.transposed(), cell.shape);
            result.shape += weight * shape;
            for (std::size_t axis = 0; axis < 4; ++axis)
                by_sample[axis] += slope[axis] * shape;
            const auto second = turned(cell.map.second, turn);
            for (std::size_t i = 0; i < second.size(); ++i)
                result.second[i] += weight * second[i];
        });
        const auto along = [&](Plane2 tangent) {
            Symmetric2 d;
            for (std::size_t axis = 0; axis < 4; ++axis)
                d += inner(cells_[here].samples_by_step[axis], tangent) * by_sample[axis];
            return d;
        };
        const PlaneMatrix turn = cells_[here].frame.turn_of(frame);
        const Symmetric2 du = along(turn.first), dv = along(turn.second);
        result.divergence = {du.xx + dv.xy, du.xy + dv.yy};
        return result;
    }

    [[nodiscard]] const AreaCells& cells() const { return grid_; }

private:
    struct Cell {
        EmissionFrame frame;   ///< of the photon nearest to the middle, of those on the path that most of them took
        PathDerivatives map{}; ///< at the middle; derivatives along the frame's tangents
        std::array<Plane2, 4> samples_by_step{};
        Symmetric2 log_q{}, shape{};
        std::uint32_t signature = 0;
        bool has_frame = false, is_resolved = false;
        std::optional<AreaBorder> border{};
        double border_distance = std::numeric_limits<double>::infinity(); ///< along the tangents, in their units
        Plane2 border_direction{};
    };

    AreaField(const AreaPhotons& photons, const FieldOptions& options, const TaskRunner& run)
        : options_(options), grid_(photons.samples(), photons.cell_counts()), cells_(grid_.size()) {
        const auto for_each_cell = [&](const auto& work) { for_each_index(run, cells_.size(), 32, work); };
        for_each_cell([&](std::size_t cell) { choose_frame(cell, photons); });
        for_each_cell([&](std::size_t cell) { fit(cell, photons); });
        if (options_.smoothing) {
            for (Cell& cell : cells_)
                cell.shape = Symmetric2::isotropic(square(*options_.smoothing));
        } else {
            for_each_cell([&](std::size_t cell) { find_border(cell, photons); });
            pass_borders_on();
            for_each_cell([&](std::size_t cell) { choose_shape(cell); });
        }
    }

    void choose_frame(std::size_t index, const AreaPhotons& photons) {
        Cell& cell = cells_[index];
        const auto signature = photons.commonest_path(grid_.photons(index));
        if (!signature)
            return;
        cell.signature = *signature;
        cell.has_frame = true;
        double nearest = std::numeric_limits<double>::infinity();
        for (const std::uint32_t i : grid_.photons(index)) {
            if (!photons.tells_of(i, cell.signature))
                continue;
            const double distance2 = length2_of(grid_.from_middle(index, photons.samples()[i], false));
            if (distance2 < nearest) {
                nearest = distance2;
                cell.frame = photons[i].frame;
            }
        }
    }

    [[nodiscard]] static double length2_of(const AreaSample& v) {
        return v[0] * v[0] + v[1] * v[1] + (v[2] * v[2] + v[3] * v[3]);
    }

    /// Fits the derivatives to the photons of this cell and those around it, weighted by a biweight about its middle.
    void fit(std::size_t index, const AreaPhotons& photons) {
        Cell& cell = cells_[index];
        if (!cell.has_frame)
            return;
        constexpr double reach = 1.2; // cells
        AreaFit fit;
        grid_.for_each_around(index, [&](const std::array<int, 4>&, std::size_t other) {
            if (other == grid_.size())
                return;
            for (const std::uint32_t i : grid_.photons(other)) {
                const double rest =
                    1 - length2_of(grid_.from_middle(index, photons.samples()[i], true)) / square(reach);
                if (!(rest > 0) || !photons.tells_of(i, cell.signature))
                    continue;
                AreaSample away = grid_.from_middle(index, photons.samples()[i], false);
                for (std::size_t axis = 0; axis < 4; ++axis)
                    away[axis] /= double(grid_.counts()[axis]);
                fit.add(cell.frame.step_to(photons[i].frame),
                        turned(photons[i].tangents, cell.frame.turn_of(photons[i].frame)), away, rest * rest);
            }
        });
        double rough = 0;
        if (!fit.solve(cell.map, cell.samples_by_step, rough))
            return;
        cell.log_q = log_bending(slice_bending(cell.map, options_.photons, rough), options_.bounds);
        cell.is_resolved = std::isfinite(cell.log_q.trace()) && std::isfinite(cell.log_q.xy);
    }

    [[nodiscard]] bool are_linked(std::size_t a, std::size_t b) const {
        return a == b || (cells_[a].is_resolved && cells_[b].is_resolved && cells_[a].signature == cells_[b].signature);
    }

    void find_border(std::size_t index, const AreaPhotons& photons) {
        Cell& cell = cells_[index];
        if (!cell.is_resolved)
            return;
        cell.border = border_about(grid_, index, photons.samples(),
                                   [&](std::uint32_t i) { return photons.is_on(i, cell.signature); });
        if (cell.border && !meet(cell, *cell.border))
            cell.border.reset();
    }

    /// @return  whether a border is nearer than those met so far, and within reach
    [[nodiscard]] bool meet(Cell& cell, const AreaBorder& border) const {
        Plane2 by_step{}; // how fast a step along the tangents comes nearer
        for (std::size_t axis = 0; axis < 4; ++axis)
            by_step = by_step + border.outwards[axis] * double(grid_.counts()[axis]) * cell.samples_by_step[axis];
        const double speed = std::sqrt(inner(by_step, by_step));
        const double distance = (std::max)(0.0, border.ahead) / speed;
        if (!(distance < (1 - 1e-9) * cell.border_distance) || distance > options_.bounds.largest_radius)
            return false;
        cell.border_distance = distance;
        cell.border_direction = (1 / speed) * by_step;
        return true;
    }

    /// From cells that a border passes to those whose footprints reach it.
    void pass_borders_on() {
        std::vector<std::size_t> source(cells_.size()), pending;
        for (std::size_t index = 0; index < cells_.size(); ++index)
            if (cells_[index].border) {
                source[index] = index;
                pending.push_back(index);
            }
        for (std::size_t next = 0; next < pending.size(); ++next) { // a queue: nearer borders arrive first, or replace
            const std::size_t from = pending[next], at = source[from];
            grid_.for_each_around(from, [&](const std::array<int, 4>&, std::size_t to) {
                if (to == grid_.size() || to == from || !are_linked(from, to))
                    return;
                const AreaBorder seen = cells_[at].border->seen_from(grid_.place_of(at), grid_.place_of(to));
                if (seen.ahead > 0 && meet(cells_[to], seen)) {
                    source[to] = at;
                    pending.push_back(to);
                }
            });
        }
    }

    void choose_shape(std::size_t index) {
        Cell& cell = cells_[index];
        if (!cell.is_resolved)
            return;
        double weights = 0;
        Symmetric2 blurred{};
        grid_.for_each_around(index, [&](const std::array<int, 4>& step, std::size_t other) {
            if (other == grid_.size() || !are_linked(index, other))
                return;
            double weight = 1; // of a (1 2 1) blur along each number
            for (const int s : step)
                weight *= 2 - std::abs(s);
            blurred += weight * congruent(cell.frame.turn_of(cells_[other].frame), cells_[other].log_q);
            weights += weight;
        });
        Symmetric2 shape = area_smoothing_tensor((1 / weights) * blurred, options_.stratified, options_.bounds);
        if (std::isfinite(cell.border_distance))
            shape =
                bounded_along(shape, cell.border_direction, (std::max)(least_border_radius, 2 * cell.border_distance));
        cell.shape = options_.scale * shape;
    }

    static constexpr double least_border_radius = 8;

    FieldOptions options_;
    AreaCells grid_;
    std::vector<Cell> cells_;
};

} // namespace nephroid::detail
