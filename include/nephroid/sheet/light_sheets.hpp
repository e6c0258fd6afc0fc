// SPDX-License-Identifier: MIT
/// @file  Light sheets: patches of light between photons, drawn onto the pixels of a receiver.
#pragma once

#include "nephroid/emission/chart/charts_of.hpp"
#include "nephroid/execution/checked_executor.hpp"
#include "nephroid/pass/photon_pass.hpp"
#include "nephroid/sheet/chart_sheets.hpp"
#include "nephroid/sheet/pilot_grid.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace nephroid {

/// Adds a lamp's caustics to the sums, as sheets between photons: for lamps with charts, and for scenes that draw no
/// random numbers, so that the point of emission determines a photon's path.
///
/// @param scene      as for `caustics`; `SheetAccount::by_chance` counts where it asked for a random number
/// @param light      one light or a set
/// @param sums       what is added to
/// @param pass       about `count` photons are traced in all: a sixteenth as a pilot, the others as corners of cells,
///                   the regular ones first, then those of cells that are split. A few more find where sheets end
///                   within cells. A pass that is a part of a picture (`total` above `count`) draws the whole
///                   picture, with the weight count / total: all of its passes must have the same `count`, and `first`
///                   must be a multiple of it
/// @param options    how finely sheets are drawn
/// @param executor   the sums do not depend on it, bit for bit
/// @param take_over  take_over(chart, rectangle): called for each part of a chart whose sheets are too broken to be
///                   drawn, from the calling thread; then no light that is emitted there is in the sums
/// Throws std::invalid_argument for a pass or options that make no sense, and if the executor leaves tasks out.
/// @return  what became of the light. Nothing is drawn of a lamp that has no charts, see `without_charts`
template <class S, class L, Vector3 V, Flux F, class R, class E = SerialExecutor, class TakeOver = DrawBroken>
SheetStatistics light_sheets(const S& scene, const L& light, Sums<V, F, R>& sums, const PhotonPass& pass,
                             const SheetOptions& options = {}, E&& executor = E{}, TakeOver take_over = {}) {
    detail::check(pass, "nephroid::light_sheets");
    detail::check(options, "nephroid::light_sheets");
    detail::CheckedExecutor checked(executor);
    SheetStatistics statistics;
    if (sums.map().tree().empty())
        return statistics;
    const detail::ReceiverPixels<V> pixels(sums.map(), checked);
    const double total = double(pass.emitted_in_all());
    const std::uint64_t number = pass.first / pass.count; // of a pass among equal ones
    const LampCharts<V, F> lamps = charts_of(light, options.lamp_points, std::size_t(number) * options.lamp_points);
    const EmissionCharts<V, F>& charts = lamps.charts;
    statistics.without_charts = lamps.power_without;
    const Refinement& refinement = options.refinement;
    const detail::PilotResult pilot =
        detail::PilotGrid<S, V, F>(scene, pixels, refinement, pass.limits)(charts, pass.count, checked);
    statistics.sheets.nodes += pilot.nodes;
    statistics.sheets.by_chance += pilot.by_chance;
    const double nodes = (std::max)(double(pass.count) - double(pilot.nodes), 0.0);
    const std::vector<detail::Lattice> lattices =
        detail::lattices_of(charts, pass, pilot.regular_share * nodes, refinement.levels);
    double cells = 0;
    for (const detail::Lattice& lattice : lattices)
        cells += double(lattice.cells_u * lattice.cells_v);
    for (std::size_t i = 0; i < charts.size(); ++i)
        detail::ChartSheets<S, V, F, R, decltype(checked), TakeOver>(scene, charts[i], sums, pixels, options,
                                                                     pass.limits, pilot.brightness,
                                                                     double(pass.count) / total, checked, take_over)
            .draw(lattices[i],
                  (1 - pilot.regular_share) * nodes * double(lattices[i].cells_u * lattices[i].cells_v) / cells,
                  statistics);
    const SheetAccount& sheets = statistics.sheets;
    statistics.light.fates[std::size_t(Fate::splatted)] += sheets.seen;
    statistics.light.fates[std::size_t(Fate::splatted)] += sheets.handed_over;
    statistics.light.fates[std::size_t(Fate::unseen)] += sheets.unseen;
    statistics.unresolved -= sheets.seen.flux + sheets.unseen.flux + sheets.handed_over.flux;
    return statistics;
}

} // namespace nephroid
