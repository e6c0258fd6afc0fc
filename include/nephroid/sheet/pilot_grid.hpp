// SPDX-License-Identifier: MIT
/// @file  A coarse grid of photons, traced before the others: it tells how bright the picture is, and how many photons
///        should make the regular grid and how many should refine it.
#pragma once

#include "nephroid/sheet/block_need.hpp"
#include "nephroid/sheet/node_tracer.hpp"
#include "nephroid/sheet/sheet_grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace nephroid::detail {

/// What a pilot grid tells of the light.
struct PilotResult {
    Brightness brightness;
    double regular_share = 1;    ///< of the photons, for the regular grid; the others refine it
    std::uint64_t nodes = 0;     ///< traced
    std::uint64_t by_chance = 0; ///< of them, those whose scene drew a random number
};

/// Traces the pilot grids of a lamp's charts.
template <class S, Vector3 V, Flux F>
class PilotGrid {
public:
    using T = scalar_t<V>;

    PilotGrid(const S& scene, const ReceiverPixels<V>& pixels, const Refinement& rule, const WalkLimits& limits)
        : scene_(scene), pixels_(pixels), rule_(rule), limits_(limits) {}

    /// @param count  photons of the whole pass: a sixteenth as many are traced here, on at most four of the charts
    template <class E>
    [[nodiscard]] PilotResult operator()(const EmissionCharts<V, F>& charts, std::uint64_t count, E& executor) {
        double power = 0;
        for (const auto& chart : charts)
            power += chart.power;
        const std::size_t looked_at = (std::min)(charts.size(), std::size_t(4));
        const double pilots = (std::max)(double(count) / 16, 25.0) / double((std::max)(looked_at, std::size_t(1)));
        double seen = 0, power_seen = 0;
        double wanted = 0;
        PilotResult result;
        for (std::size_t k = 0; k < looked_at; ++k) {
            const EmissionChart<V, F>& chart = charts[k * charts.size() / looked_at];
            // How many times smaller the cells of a regular grid of all photons would be.
            const double finer = std::sqrt((std::max)(double(count) * chart.power / power / pilots, 1.0));
            visit_blocks(chart, lattice_of(chart, pilots, 1, 0), executor, result,
                         [&](double flux, const BlockNeed& need) {
                             seen += flux;
                             wanted += photons_on_finer(need, finer);
                         });
            power_seen += chart.power;
        }
        if (power_seen > 0 && pixels_.area() > 0)
            result.brightness.mean = seen * power / power_seen / pixels_.area();
        if (rule_.levels > 0 && power_seen > 0)
            result.regular_share = std::clamp(double(count) / (double(count) + wanted * power / power_seen), 0.4, 0.9);
        return result;
    }

private:
    /// How many photons a block would need in addition to those of a grid whose cells are smaller by a factor.
    [[nodiscard]] double photons_on_finer(BlockNeed need, double factor) const {
        const double blocks = need.is_broken ? factor : square(factor); // along a line, or all of them
        need.ratio = need.ratio / float(need.is_broken ? factor : factor * square(factor));
        return blocks * need.photons(rule_.levels);
    }

    template <class E, class Visit>
    void visit_blocks(const EmissionChart<V, F>& chart, const Lattice& lattice, E& executor, PilotResult& result,
                      const Visit& visit) {
        const CellRange all{0, lattice.cells_u, 0, lattice.cells_v};
        std::vector<TracedNodes> traced(grid_.tasks_of(lattice, all));
        const auto trace = [&](const LatticePlace& place, std::vector<NodeEnd<V, F>>& ends, std::size_t task) {
            trace_node(scene_, chart, T(lattice.u(place)), T(lattice.v(place)), 0, pixels_.map().tree().origin(),
                       limits_, ends, traced[task]);
        };
        grid_.fill(lattice, all, trace, executor);
        result.nodes += grid_.size();
        for (const TracedNodes& some : traced)
            result.by_chance += some.by_chance;
        const BlockNeeds<V, F> needs(pixels_, rule_, lattice.area());
        const auto known = [&](const LatticePlace& p) { return grid_.has(p) ? grid_[p] : NodeEnds<V, F>{}; };
        const std::int64_t step = lattice.step();
        for (std::int64_t v = 0; v < lattice.cells_v; v += 2)
            for (std::int64_t u = 0; u < lattice.cells_u; u += 2) {
                const LatticePlace place{u * step, v * step};
                const auto block = block_at<V, F>(place, step, known);
                visit(needs.seen_flux(block, step), needs(block, place, step, known));
            }
    }

    const S& scene_;
    const ReceiverPixels<V>& pixels_;
    const Refinement& rule_;
    const WalkLimits& limits_;
    NodeGrid<V, F> grid_;
};

} // namespace nephroid::detail
