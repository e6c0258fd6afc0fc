// SPDX-License-Identifier: MIT
/// @file  What the photons of one sheet say of one another: derivatives, shapes and borders over a light's domain.
#pragma once

#include "nephroid/estimate/second_order/bending.hpp"
#include "nephroid/estimate/second_order/emission_sheets.hpp"
#include "nephroid/estimate/second_order/roughness.hpp"
#include "nephroid/estimate/second_order/smoothing_rule.hpp"
#include "nephroid/estimate/second_order/varying_shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace nephroid {

/// What chooses the footprints.
struct FieldOptions {
    std::optional<double> smoothing{}; ///< s for all photons; nothing: chosen for each by `smoothing_tensor`
    bool stratified = false;           ///< whether the photons come from a stratified sequence
    bool repeats = false;              ///< the scene repeats over the light's domain
    double scale = 1;                  ///< of S: the biweight's second moment over the kernel's own
    double photons = 0;                ///< emitted into this domain in all; those that the field is made from are fewer
    SmoothingBounds bounds{};
};

/// What the field says about one photon, in its own emission frame.
struct FieldSample {
    Symmetric2 shape;             ///< S
    Plane2 divergence;            ///< ∂_a S_ab
    std::array<Space3, 3> second; ///< H
};

/// Shapes of footprints and second derivatives over one sheet, on a grid of cells.
class SheetField {
public:
    /// @param all     photons of the light, emitted with smoothing 1, whose samples are two numbers
    /// @param sheets  theirs
    /// @param sheet   one of those
    /// @param run     runs the fits; the field does not depend on it
    SheetField(const PathSamples& all, const EmissionSheets& sheets, const EmissionSheet& sheet,
               const FieldOptions& options, const TaskRunner& run)
        : options_(options), density_{options.stratified, sheet.share}, aspect_(sheets.aspect()),
          grid_(places_of(all, sheet), sheets.aspect(), options.repeats,
                photons_per_cell(options, sheet) * double(sheet.photons.size()) / (double(all.size()) * sheet.share)),
          slots_(grid_.size(), nowhere) {
        PathSamples photons;
        for (const std::uint32_t i : sheet.photons)
            photons.add(all[i]);
        for (std::size_t square = 0; square < grid_.size(); ++square)
            if (!grid_.photons(square).empty()) {
                slots_[square] = std::uint32_t(cells_.size());
                cells_.push_back({.square = square});
            }
        const auto for_each_cell = [&](const auto& work) {
            detail::for_each_index(run, cells_.size(), 32, [&](std::size_t i) { work(cells_[i]); });
        };
        for_each_cell([&](Cell& cell) {
            choose_frame(cell, photons);
            for (const std::uint32_t i : grid_.photons(cell.square))
                cell.is_next_to_border = cell.is_next_to_border || sheets.is_next_to_border(sheet.photons[i]);
        });
        for_each_cell([&](Cell& cell) { fit(cell, photons); });
        if (options_.smoothing) {
            for (Cell& cell : cells_)
                cell.shape = Symmetric2::isotropic(square(*options_.smoothing));
            return;
        }
        find_borders(photons);
        for_each_cell([&](Cell& cell) { choose_shape(cell); });
    }

    /// Nothing where the photons say nothing: there are too few of them.
    [[nodiscard]] std::optional<FieldSample> at(const std::array<double, 2>& sample, const EmissionFrame& frame) const {
        const Cell* here = cell_in(grid_.cell_of(sample));
        if (here == nullptr || !here->is_resolved)
            return std::nullopt;
        FieldSample result{};
        VaryingShape shape;
        const PlaneMatrix& metric = here->metric_by_side[side_of(sample)];
        const PlaneMatrix samples_by_place = (frame.axes_of(here->frame) * metric).inverse();
        for (const Node& node : nodes_about(sample)) {
            const Cell* there = cell_in(node.square);
            const Cell& cell = there != nullptr && there->is_resolved ? *there : *here;
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
        bound_by_domain(shape, sample, samples_by_place);
        result.shape = shape.value;
        result.divergence = {shape.along_u.xx + shape.along_v.xy, shape.along_u.xy + shape.along_v.yy};
        return result;
    }

private:
    static constexpr std::uint32_t nowhere = (std::numeric_limits<std::uint32_t>::max)();

    /// Photons that keep apart determine derivatives by fewer, from smaller cells; what chance leaves of them does not.
    [[nodiscard]] static double photons_per_cell(const FieldOptions& options, const EmissionSheet& sheet) {
        return options.stratified && sheet.share == 1 ? 9 : EmissionCells::photons_per_cell;
    }

    /// A square of the grid with photons in it.
    struct Cell {
        std::size_t square;
        EmissionFrame frame{}; ///< of the photon nearest to the middle
        std::array<double, 2> frame_sample{};
        double size2 = 0;     ///< of that photon's tangents
        PlaneMatrix metric{}; ///< steps between samples to displacements in the frame
        std::array<PlaneMatrix, 2> metric_by_side{};
        PathDerivatives map{}; ///< at the middle
        Symmetric2 log_q{}, shape{};
        bool has_frame = false, is_resolved = false;
        bool is_next_to_border = false;                                   ///< which lies within it
        double border_distance = std::numeric_limits<double>::infinity(); ///< of the middle, in the frame's units; less
                                                                          ///< than 0 beyond the border
        Plane2 border_direction{};                                        ///< unit, or 0 where the border is all around
    };

    /// A corner of the square of cell middles about a sample.
    struct Node {
        std::size_t square;
        double weight;               ///< bilinear
        std::array<double, 2> slope; ///< of the weight, by the samples
    };

    [[nodiscard]] static std::vector<std::array<double, 2>> places_of(const PathSamples& all,
                                                                      const EmissionSheet& sheet) {
        std::vector<std::array<double, 2>> places;
        places.reserve(sheet.photons.size());
        for (const std::uint32_t i : sheet.photons)
            places.push_back(all[i].sample.at);
        return places;
    }

    [[nodiscard]] const Cell* cell_in(std::size_t square) const {
        return slots_[square] == nowhere ? nullptr : &cells_[slots_[square]];
    }

    void choose_frame(Cell& cell, const PathSamples& photons) {
        const auto inside = grid_.photons(cell.square);
        const auto middle = grid_.middle(cell.square);
        double nearest = std::numeric_limits<double>::infinity();
        for (const std::uint32_t i : inside) {
            if (!photons[i].frame.is_regular())
                continue;
            const Plane2 away = grid_.step_between(middle, photons[i].sample.at);
            const Plane2 in_cells{away.x * double(grid_.columns()), away.y * double(grid_.rows())};
            if (inner(in_cells, in_cells) < nearest) {
                nearest = inner(in_cells, in_cells);
                cell.frame = photons[i].frame;
                cell.frame_sample = photons[i].sample.at;
                const auto& tangents = photons[i].tangents;
                cell.size2 = inner(tangents[0], tangents[0]) + inner(tangents[1], tangents[1]);
            }
        }
        SampleMetric metric;
        const auto add = [&](std::size_t square) {
            for (const std::uint32_t i : grid_.photons(square))
                metric.add(grid_.step_between(cell.frame_sample, photons[i].sample.at),
                           cell.frame.to(photons[i].frame));
        };
        add(cell.square);
        auto solved = metric.solve();
        if (!solved) { // a border leaves few photons to a cell, or all of them in a line
            for_each_around(cell, [&](const Cell& other, double) {
                if (&other != &cell)
                    add(other.square);
            });
            solved = metric.solve();
        }
        if (solved && std::isfinite(nearest)) {
            cell.metric = *solved;
            cell.metric_by_side = {metric_on_side(cell, photons, 0), metric_on_side(cell, photons, 1)};
            cell.has_frame = true;
        }
    }

    /// Which pair of the square's triangles a sample lies in. A concentric map of the square onto a disk has a kink along
    /// its diagonals.
    [[nodiscard]] static std::size_t side_of(const std::array<double, 2>& sample) {
        return std::abs(sample[0] - 0.5) > std::abs(sample[1] - 0.5) ? 0 : 1;
    }

    /// The metric by those photons of a cell and of those around it that lie on one side of a diagonal; that of the cell
    /// if no diagonal passes through it.
    [[nodiscard]] PlaneMatrix metric_on_side(const Cell& cell, const PathSamples& photons, std::size_t side) const {
        const auto is_here = [&](std::uint32_t i) { return side_of(photons[i].sample.at) == side; };
        const auto inside = grid_.photons(cell.square);
        if (std::all_of(inside.begin(), inside.end(), is_here) || std::none_of(inside.begin(), inside.end(), is_here))
            return cell.metric;
        Plane2 step_sum{}, place_sum{};
        double weights = 0;
        const auto for_each = [&](const auto& visit) {
            for_each_around(cell, [&](const Cell& other, double weight) {
                for (const std::uint32_t i : grid_.photons(other.square))
                    if (is_here(i))
                        visit(grid_.step_between(cell.frame_sample, photons[i].sample.at),
                              cell.frame.to(photons[i].frame), weight);
            });
        };
        for_each([&](Plane2 step, Plane2 place, double weight) {
            step_sum = step_sum + weight * step;
            place_sum = place_sum + weight * place;
            weights += weight;
        });
        SampleMetric metric;
        for_each([&](Plane2 step, Plane2 place, double weight) {
            const double root = std::sqrt(weight), share = 1 / weights;
            metric.add(root * (step + -share * step_sum), root * (place + -share * place_sum));
        });
        return metric.solve().value_or(cell.metric);
    }

    /// Fits the derivatives to the photons of this cell and those around it, weighted by a biweight about its middle.
    void fit(Cell& cell, const PathSamples& photons) {
        if (!cell.has_frame)
            return;
        const auto middle = grid_.middle(cell.square);
        const Plane2 to_middle = cell.metric(grid_.step_between(cell.frame_sample, middle));
        const double cell_area = std::abs(cell.metric.determinant()) / double(grid_.size());
        const double reach2 = 1.44 * cell_area; // 1.2 cells
        std::vector<TangentResidual> here;
        PathFit fit;
        for_each_around(cell, [&](const Cell& other, double) {
            for (const std::uint32_t i : grid_.photons(other.square)) {
                const PathSample& photon = photons[i];
                if (!photon.frame.is_regular())
                    continue;
                // A repeated domain's photons lie where a step leads to, not where they were emitted.
                const Plane2 at = grid_.repeats() ? cell.metric(grid_.step_between(middle, photon.sample.at))
                                                  : cell.frame.to(photon.frame) + -1.0 * to_middle;
                const double rest = 1 - inner(at, at) / reach2;
                if (!(rest > 0))
                    continue;
                const auto& tangents = photon.tangents;
                if (!std::isfinite(inner(tangents[0], tangents[0]) + inner(tangents[1], tangents[1])))
                    continue; // will be an invalid splat, and must not be its neighbours' end
                const PlaneMatrix axes = photon.frame.axes_of(cell.frame);
                const std::array<Space3, 2> by_axes{axes.first.x * tangents[0] + axes.first.y * tangents[1],
                                                    axes.second.x * tangents[0] + axes.second.y * tangents[1]};
                // By its own measure where that is larger than the middle's: beside a pole of the map a few photons would
                // else decide for all.
                const double size2 = inner(by_axes[0], by_axes[0]) + inner(by_axes[1], by_axes[1]);
                fit.add(at, by_axes, rest * rest * (cell.size2 > 0 ? cell.size2 / (cell.size2 + size2) : 0.5));
                if (&other == &cell)
                    here.push_back({{at.x, at.y, 0, 0}, by_axes, {}});
            }
        });
        cell.is_resolved = fit.solve(cell.map);
        if (!cell.is_resolved)
            return;
        for (TangentResidual& photon : here) {
            const auto fitted = tangents_at(cell.map, {photon.at[0], photon.at[1]});
            photon.unexplained = {photon.tangents[0] - fitted[0], photon.tangents[1] - fitted[1]};
        }
        const Symmetric2 q =
            bending(cell.map, options_.photons, density_.share, roughness(here), options_.bounds.stretch);
        cell.log_q = log_bending(q, options_.bounds);
        cell.is_resolved = cell.is_resolved && std::isfinite(cell.log_q.trace()) && std::isfinite(cell.log_q.xy);
    }

    /// Calls visit(cell, weight) for a cell and those of the eight around it that have photons; weights are those of a
    /// (1 2 1)² blur.
    template <class Visit>
    void for_each_around(const Cell& cell, Visit&& visit) const {
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx)
                if (const auto square = grid_.neighbour(cell.square, dx, dy))
                    if (const Cell* other = cell_in(*square))
                        visit(*other, double((2 - std::abs(dx)) * (2 - std::abs(dy))));
    }

    [[nodiscard]] Plane2 displacement(const Cell& from, const Cell& to) const {
        return from.metric(grid_.step_between(grid_.middle(from.square), grid_.middle(to.square)));
    }

    /// Whether the sheet ends in a cell or beside it, elsewhere than with the domain.
    [[nodiscard]] bool ends_about(const Cell& cell) const {
        bool ends = cell.is_next_to_border;
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx)
                if (const auto square = grid_.neighbour(cell.square, dx, dy)) {
                    const Cell* other = cell_in(*square);
                    ends = ends || other == nullptr || !other->is_resolved;
                }
        return ends;
    }

    /// Lays the border of the sheet through or beside a cell: beyond the outermost of the photons about it, in the
    /// direction where they are missing. All around the cell where they are missing on no side more than on another.
    void lay_border(Cell& cell, const PathSamples& photons) const {
        const auto middle = grid_.middle(cell.square);
        const double side = std::sqrt(std::abs(cell.metric.determinant()) / double(grid_.size()));
        Plane2 of_photons{}, of_squares{};
        double squares = 0;
        std::vector<Plane2> places;
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx)
                if (const auto square = grid_.neighbour(cell.square, dx, dy)) {
                    of_squares = of_squares + cell.metric(grid_.step_between(middle, grid_.middle(*square)));
                    squares += 1;
                    for (const std::uint32_t i : grid_.photons(*square)) {
                        places.push_back(cell.metric(grid_.step_between(middle, photons[i].sample.at)));
                        of_photons = of_photons + places.back();
                    }
                }
        const Plane2 missing = (1 / squares) * of_squares + (-1 / double(places.size())) * of_photons;
        cell.border_distance = 0.5 * side;
        if (!(inner(missing, missing) > square(0.1 * side)))
            return;
        const Plane2 outwards = unit(missing), across{-outwards.y, outwards.x};
        double outermost = -1.5 * side;
        for (const Plane2 place : places)
            if (std::abs(inner(place, across)) < 0.5 * side)
                outermost = (std::max)(outermost, inner(place, outwards));
        cell.border_distance = outermost;
        cell.border_direction = outwards;
    }

    /// The distance and direction from each cell to where the sheet ends within the domain. Passed on from cell to cell,
    /// no further than footprints reach.
    void find_borders(const PathSamples& photons) {
        std::vector<std::uint32_t> border(cells_.size(), nowhere), pending;
        for (std::uint32_t index = 0; index < cells_.size(); ++index)
            if (cells_[index].is_resolved && ends_about(cells_[index])) {
                lay_border(cells_[index], photons);
                border[index] = index;
                pending.push_back(index);
            }
        for (std::size_t next = 0; next < pending.size(); ++next) { // a queue: nearer borders arrive first, or replace
            const std::uint32_t from = border[pending[next]];
            for_each_around(cells_[pending[next]], [&](const Cell& other, double) {
                const std::uint32_t index = slots_[other.square];
                if (!other.is_resolved || index == pending[next])
                    return;
                const Plane2 away = displacement(other, cells_[from]);
                const double distance = cells_[from].border_distance + std::sqrt(inner(away, away));
                const double known = other.border_distance;
                if ((std::isfinite(known) && !(distance < known - 1e-9 * std::abs(known))) ||
                    distance > options_.bounds.largest_radius)
                    return;
                cells_[index].border_distance = distance;
                cells_[index].border_direction = unit(away);
                border[index] = from;
                pending.push_back(index);
            });
        }
    }

    [[nodiscard]] static Plane2 unit(Plane2 v) {
        const double norm = std::sqrt(inner(v, v));
        return norm > 1e-6 ? (1 / norm) * v : Plane2{};
    }

    void choose_shape(Cell& cell) {
        if (!cell.is_resolved)
            return;
        double weights = 0;
        Symmetric2 blurred{};
        for_each_around(cell, [&](const Cell& other, double weight) {
            if (!other.is_resolved)
                return;
            blurred += weight * congruent(cell.frame.axes_of(other.frame), other.log_q);
            weights += weight;
        });
        cell.shape = options_.scale * smoothing_tensor((1 / weights) * blurred, density_, options_.bounds);
    }

    /// How far a footprint may reach towards a border, and how that changes with the distance to it.
    struct Reach {
        double most, by_distance;
    };

    [[nodiscard]] Reach reach_to(double distance) const {
        const double unit_reach = std::sqrt(options_.scale), least = options_.bounds.least_radius;
        return distance > least ? Reach{unit_reach * distance, unit_reach} : Reach{unit_reach * least, 0};
    }

    /// A cell's shape where a photon is, in the cell's frame: no wider than the sheet.
    ///
    /// @param steps  a step along the photon's axes in the cell's frame, by columns
    [[nodiscard]] VaryingShape shape_in(const Cell& cell, const std::array<double, 2>& sample,
                                        const PlaneMatrix& steps) const {
        VaryingShape shape{cell.shape, {}, {}};
        if (!std::isfinite(cell.border_distance) || options_.smoothing)
            return shape;
        const Plane2 n = cell.border_direction;
        if (!(inner(n, n) > 0)) {
            const double most = square(reach_to(cell.border_distance).most);
            const Principal2 principal(shape.value);
            shape.value = principal.with((std::min)(principal.larger, most), (std::min)(principal.smaller, most));
            return shape;
        }
        const Plane2 away = cell.metric(grid_.step_between(grid_.middle(cell.square), sample));
        const Reach reach = reach_to(cell.border_distance - inner(n, away));
        shape.bound_along(n, reach.most,
                          {-reach.by_distance * inner(n, steps.first), -reach.by_distance * inner(n, steps.second)});
        return shape;
    }

    /// Bounds a photon's shape, in its own frame, by the borders of the light's domain.
    void bound_by_domain(VaryingShape& shape, const std::array<double, 2>& sample,
                         const PlaneMatrix& samples_by_place) const {
        if (grid_.repeats() || options_.smoothing)
            return;
        const std::array<Plane2, 2> slopes{{{samples_by_place.first.x, samples_by_place.second.x},
                                            {samples_by_place.first.y, samples_by_place.second.y}}};
        const std::array<double, 2> steepness{std::sqrt(inner(slopes[0], slopes[0])),
                                              std::sqrt(inner(slopes[1], slopes[1]))};
        // Where the borders of the two samples do not meet at a right angle there is no corner: a disk's border is all
        // four sides of the square, and the one is that of the triangle that the sample lies in.
        const double lean = std::abs(inner(slopes[0], slopes[1])) / (steepness[0] * steepness[1]);
        const auto room = [&](std::size_t axis) { return (std::min)(sample[axis], 1 - sample[axis]); };
        const std::size_t nearest = room(0) * aspect_ < room(1) ? 0 : 1;
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

    [[nodiscard]] std::array<Node, 4> nodes_about(const std::array<double, 2>& sample) const {
        struct Axis {
            std::array<std::size_t, 2> at;
            double share;
        };
        const auto along = [this](double u, std::size_t count) {
            const double place = u * double(count) - 0.5, low = std::floor(place);
            const auto bring_back = [&](double i) {
                if (grid_.repeats())
                    return std::size_t(i < 0 ? i + double(count) : i >= double(count) ? i - double(count) : i);
                return std::size_t(std::clamp(i, 0.0, double(count) - 1));
            };
            return Axis{{bring_back(low), bring_back(low + 1)}, place - low};
        };
        const Axis x = along(sample[0], grid_.columns()), y = along(sample[1], grid_.rows());
        std::array<Node, 4> nodes;
        for (std::size_t i = 0; i < 4; ++i) {
            const bool right = i & 1, up = i & 2;
            const double wx = right ? x.share : 1 - x.share, wy = up ? y.share : 1 - y.share;
            nodes[i] = {y.at[up] * grid_.columns() + x.at[right],
                        wx * wy,
                        {(right ? wy : -wy) * double(grid_.columns()), (up ? wx : -wx) * double(grid_.rows())}};
        }
        return nodes;
    }

    FieldOptions options_;
    PhotonDensity density_;
    double aspect_; // of the domain: its length along the first sample over that along the second
    EmissionCells grid_;
    std::vector<std::uint32_t> slots_; // of each square: its cell, or nowhere
    std::vector<Cell> cells_;
};

} // namespace nephroid
