// SPDX-License-Identifier: MIT
/// @file  What the photons of a light say about one another: derivatives, shapes and borders over its domain.
#pragma once

#include "nephroid/estimate/second_order/emission_cells.hpp"
#include "nephroid/estimate/second_order/smoothing_rule.hpp"
#include "nephroid/transport/executor.hpp"

#include <functional>
#include <limits>
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

/// Shapes of footprints and second derivatives over the emission domain of one light, on a grid of cells.
class FootprintField {
public:
    /// @param photons   of one light, emitted with smoothing 1, whose samples are two numbers: a random-access range of
    ///                  TracedPhoton
    /// @param executor  runs the fits; the field does not depend on it
    template <class Photons, class E>
    FootprintField(const Photons& photons, const FieldOptions& options, E& executor)
        : FootprintField(PathSamples(photons), options,
                         [&executor](std::size_t count, const Task& task) { executor(count, task); }) {}

    /// Nothing where the photons say nothing: too few of them, or none that took the same path.
    [[nodiscard]] std::optional<FieldSample> at(const std::array<double, 2>& sample, const EmissionFrame& frame,
                                                std::uint32_t signature) const {
        const std::size_t here = grid_.cell_of(sample);
        if (!cells_[here].is_resolved || cells_[here].signature != signature)
            return std::nullopt;
        FieldSample result{};
        std::array<Symmetric2, 2> by_sample; // ∂S by the two samples
        for (const Node& node : nodes_about(sample)) {
            const Cell& cell = cells_[are_linked(here, node.cell) ? node.cell : here];
            // Tensors turn with the axes that they are by.
            const Symmetric2 shape = congruent(frame.axes_of(cell.frame), cell.shape);
            result.shape += node.weight * shape;
            for (std::size_t axis = 0; axis < 2; ++axis)
                by_sample[axis] += node.slope[axis] * shape;
            const auto second = turned(cell.map.second, cell.frame.axes_of(frame));
            for (std::size_t i = 0; i < second.size(); ++i)
                result.second[i] += node.weight * second[i];
        }
        const PlaneMatrix samples_by_place = (frame.axes_of(cells_[here].frame) * cells_[here].metric).inverse();
        const auto derivative = [&](Plane2 by_place) { // along an axis, which is so many samples away
            Symmetric2 d = by_place.x * by_sample[0];
            d += by_place.y * by_sample[1];
            return d;
        };
        const Symmetric2 du = derivative(samples_by_place.first), dv = derivative(samples_by_place.second);
        result.divergence = {du.xx + dv.xy, du.xy + dv.yy};
        return result;
    }

private:
    using Task = std::function<void(std::size_t)>;
    using Runner = std::function<void(std::size_t, const Task&)>;

    /// The photons, whatever they carry besides: all that follows is compiled once.
    class PathSamples {
    public:
        template <class Photons>
        explicit PathSamples(const Photons& photons) : samples_(photons.size()) {
            for (std::size_t i = 0; i < samples_.size(); ++i)
                samples_[i] = &photons[i];
        }
        [[nodiscard]] std::size_t size() const { return samples_.size(); }
        [[nodiscard]] const PathSample& operator[](std::size_t i) const { return *samples_[i]; }

    private:
        std::vector<const PathSample*> samples_;
    };

    FootprintField(const PathSamples& photons, const FieldOptions& options, const Runner& run)
        : options_(options), grid_(samples_of(photons, photons.size()), aspect_of(photons), options.repeats),
          cells_(grid_.size()) {
        const auto for_each_cell = [&](const Task& work) {
            constexpr std::size_t cells_per_task = 32;
            run((cells_.size() + cells_per_task - 1) / cells_per_task, [&](std::size_t task) {
                const std::size_t end = (std::min)(cells_.size(), (task + 1) * cells_per_task);
                for (std::size_t cell = task * cells_per_task; cell < end; ++cell)
                    work(cell);
            });
        };
        for_each_cell([&](std::size_t cell) { choose_frame(cell, photons); });
        for_each_cell([&](std::size_t cell) { fit(cell, photons); });
        if (options_.smoothing) {
            for (Cell& cell : cells_)
                cell.shape = Symmetric2::isotropic(*options_.smoothing * *options_.smoothing);
            return;
        }
        find_borders();
        for_each_cell([&](std::size_t cell) { choose_shape(cell); });
    }

    struct Cell {
        EmissionFrame frame; ///< of the photon nearest to the middle, of those on the path that most of them took
        std::array<double, 2> frame_sample{};
        PlaneMatrix metric{};  ///< steps between samples to displacements in the frame
        PathDerivatives map{}; ///< at the middle
        Symmetric2 log_q{}, shape{};
        std::uint32_t signature = 0;
        bool has_frame = false, is_resolved = false;
        bool is_mixed = false; ///< some of its photons took another path, or were lost
        double border_distance = std::numeric_limits<double>::infinity(); ///< in the frame's units
        Plane2 border_direction{};                                        ///< unit, or 0 where the border is all around
    };

    /// A corner of the square of cell middles about a sample.
    struct Node {
        std::size_t cell;
        double weight;               ///< bilinear
        std::array<double, 2> slope; ///< of the weight, by the samples
    };

    [[nodiscard]] static std::vector<std::array<double, 2>> samples_of(const PathSamples& photons, std::size_t count) {
        std::vector<std::array<double, 2>> samples(count);
        for (std::size_t i = 0; i < count; ++i)
            samples[i] = photons[i].sample.at;
        return samples;
    }

    /// How much longer the domain is along the first sample than along the second.
    [[nodiscard]] static double aspect_of(const PathSamples& photons) {
        const EmissionCells coarse(samples_of(photons, (std::min)(photons.size(), std::size_t(4096))), 1, false);
        double sum = 0;
        std::size_t count = 0;
        for (std::size_t cell = 0; cell < coarse.size(); ++cell) {
            const auto inside = coarse.photons(cell);
            if (inside.empty() || !photons[inside.front()].frame.is_regular())
                continue;
            const auto& origin = photons[inside.front()];
            SampleMetric metric;
            for (const std::uint32_t i : inside)
                metric.add(coarse.step_between(origin.sample.at, photons[i].sample.at),
                           origin.frame.to(photons[i].frame));
            if (const auto m = metric.solve()) {
                sum += 0.5 * std::log(inner(m->first, m->first) / inner(m->second, m->second));
                ++count;
            }
        }
        return count > 0 && std::isfinite(sum) ? std::clamp(std::exp(sum / double(count)), 1e-3, 1e3) : 1;
    }

    void choose_frame(std::size_t index, const PathSamples& photons) {
        Cell& cell = cells_[index];
        const auto inside = grid_.photons(index);
        std::size_t most = 0;
        for (const std::uint32_t i : inside) {
            if (!photons[i].has_landed || !photons[i].frame.is_regular())
                continue;
            std::size_t same = 0;
            for (const std::uint32_t j : inside)
                same += photons[j].has_landed && photons[j].signature == photons[i].signature;
            if (same > most || (same == most && photons[i].signature < cell.signature)) {
                most = same;
                cell.signature = photons[i].signature;
            }
        }
        cell.is_mixed = most < inside.size();
        if (most == 0)
            return;

        const auto middle = grid_.middle(index);
        double nearest = std::numeric_limits<double>::infinity();
        for (const std::uint32_t i : inside) {
            if (!is_on(cell, photons[i]) || !photons[i].frame.is_regular())
                continue;
            const Plane2 away = grid_.step_between(middle, photons[i].sample.at);
            const Plane2 in_cells{away.x * double(grid_.columns()), away.y * double(grid_.rows())};
            if (inner(in_cells, in_cells) < nearest) {
                nearest = inner(in_cells, in_cells);
                cell.frame = photons[i].frame;
                cell.frame_sample = photons[i].sample.at;
            }
        }
        SampleMetric metric;
        for (const std::uint32_t i : inside)
            if (is_on(cell, photons[i]))
                metric.add(grid_.step_between(cell.frame_sample, photons[i].sample.at),
                           cell.frame.to(photons[i].frame));
        if (const auto m = metric.solve()) {
            cell.metric = *m;
            cell.has_frame = true;
        }
    }

    [[nodiscard]] static bool is_on(const Cell& cell, const PathSample& photon) {
        return photon.has_landed && photon.signature == cell.signature;
    }

    /// Fits the derivatives to the photons of this cell and those around it, weighted by a biweight about its middle.
    void fit(std::size_t index, const PathSamples& photons) {
        Cell& cell = cells_[index];
        if (!cell.has_frame)
            return;
        const auto middle = grid_.middle(index);
        const Plane2 to_middle = cell.metric(grid_.step_between(cell.frame_sample, middle));
        const double cell_area = std::abs(cell.metric.determinant()) / double(grid_.size());
        const double reach2 = 1.44 * cell_area; // 1.2 cells
        PathFit fit;
        for_each_around(index, [&](std::size_t other, double) {
            for (const std::uint32_t i : grid_.photons(other)) {
                const auto& photon = photons[i];
                if (!is_on(cell, photon) || !photon.frame.is_regular())
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
                fit.add(at,
                        {axes.first.x * tangents[0] + axes.first.y * tangents[1],
                         axes.second.x * tangents[0] + axes.second.y * tangents[1]},
                        rest * rest);
            }
        });
        cell.is_resolved = fit.solve(cell.map);
        if (cell.is_resolved)
            cell.log_q = log_bending(bending(cell.map, options_.photons), options_.bounds);
        cell.is_resolved = cell.is_resolved && std::isfinite(cell.log_q.trace()) && std::isfinite(cell.log_q.xy);
    }

    /// Calls visit(cell, weight) for a cell and the eight around it; weights are those of a (1 2 1)² blur.
    template <class Visit>
    void for_each_around(std::size_t index, Visit&& visit) const {
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx)
                if (const auto other = grid_.neighbour(index, dx, dy))
                    visit(*other, double((2 - std::abs(dx)) * (2 - std::abs(dy))));
    }

    [[nodiscard]] bool are_linked(std::size_t a, std::size_t b) const {
        return a == b || (cells_[a].is_resolved && cells_[b].is_resolved && cells_[a].signature == cells_[b].signature);
    }

    [[nodiscard]] Plane2 displacement(std::size_t from, std::size_t to) const {
        return cells_[from].metric(grid_.step_between(grid_.middle(from), grid_.middle(to)));
    }

    /// The distance and direction from each cell to where its sheet of the map ends: to cells on other paths, without
    /// photons, or beyond the domain. Passed on from cell to cell, no further than footprints reach.
    void find_borders() {
        constexpr std::size_t none = (std::numeric_limits<std::size_t>::max)();
        std::vector<std::size_t> border(cells_.size(), none), pending;
        for (std::size_t index = 0; index < cells_.size(); ++index) {
            Cell& cell = cells_[index];
            if (!cell.is_resolved)
                continue;
            Plane2 outwards{};
            bool ends = cell.is_mixed;
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx) {
                    const auto other = grid_.neighbour(index, dx, dy);
                    if (other && are_linked(index, *other))
                        continue;
                    ends = true;
                    const Plane2 step = cell.metric({dx / double(grid_.columns()), dy / double(grid_.rows())});
                    outwards = outwards + (1 / std::sqrt(inner(step, step))) * step;
                }
            if (!ends)
                continue;
            cell.border_distance = 0.5 * std::sqrt(std::abs(cell.metric.determinant()) / double(grid_.size()));
            cell.border_direction = unit(outwards);
            border[index] = index;
            pending.push_back(index);
        }
        for (std::size_t next = 0; next < pending.size(); ++next) { // a queue: nearer borders arrive first, or replace
            const std::size_t from = pending[next];
            for_each_around(from, [&](std::size_t to, double) {
                if (to == from || !are_linked(from, to))
                    return;
                const Plane2 away = displacement(to, border[from]);
                const double distance = cells_[border[from]].border_distance + std::sqrt(inner(away, away));
                if (!(distance < (1 - 1e-9) * cells_[to].border_distance) || distance > options_.bounds.largest_radius)
                    return;
                cells_[to].border_distance = distance;
                cells_[to].border_direction = unit(away);
                border[to] = border[from];
                pending.push_back(to);
            });
        }
    }

    [[nodiscard]] static Plane2 unit(Plane2 v) {
        const double norm = std::sqrt(inner(v, v));
        return norm > 1e-6 ? (1 / norm) * v : Plane2{};
    }

    void choose_shape(std::size_t index) {
        Cell& cell = cells_[index];
        if (!cell.is_resolved)
            return;
        double weights = 0;
        Symmetric2 blurred{};
        for_each_around(index, [&](std::size_t other, double weight) {
            if (!are_linked(index, other))
                return;
            blurred += weight * congruent(cell.frame.axes_of(cells_[other].frame), cells_[other].log_q);
            weights += weight;
        });
        cell.shape = options_.scale * smoothing_tensor((1 / weights) * blurred, options_.stratified, options_.bounds);

        const Plane2 n = cell.border_direction;
        if (!std::isfinite(cell.border_distance))
            return;
        // Where the map widens towards the border, what spills over it lands further out than one would think.
        const auto& h = cell.map.second;
        const Plane2 widening = detail::EmissionPullback(cell.map.first)((n.x * n.x) * h[0] +
                                                                         ((2 * n.x * n.y) * h[1] + (n.y * n.y) * h[2]));
        const double reach = (std::max)(least_border_radius,
                                        cell.border_distance *
                                            std::clamp(1 + 0.5 * cell.border_distance * inner(n, widening), 1.0, 4.0));
        if (inner(n, n) > 0) {
            cell.shape = bounded_along(cell.shape, n, reach);
        } else {
            // Photons that were lost or went elsewhere amid the others, by chance perhaps: no reason to show photons.
            const double most = options_.scale * square((std::max)(options_.bounds.least, reach));
            const Principal2 principal(cell.shape);
            cell.shape = principal.with((std::min)(principal.larger, most), (std::min)(principal.smaller, most));
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

    static constexpr double least_border_radius = 3;

    FieldOptions options_;
    EmissionCells grid_;
    std::vector<Cell> cells_;
};

} // namespace nephroid
