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
#include <utility>
#include <vector>

namespace nephroid {

/// A receiver's vertices in the layout in which sheets are drawn onto them. One that is kept saves making it for each
/// picture, about 40 ns a vertex: for animations and viewers, whose receiver stays while the light moves.
///
/// ```cpp
/// const nephroid::SheetReceiver receiver(map);
/// for (;;) {
///     sums.clear();
///     nephroid::light_sheets(scene, light, sums, receiver, {.count = 5'000});
/// }
/// ```
template <Vector3 V>
class SheetReceiver {
public:
    /// @param map  must outlive this
    template <class E = SerialExecutor>
    explicit SheetReceiver(const EyePathMap<V>& map, E&& executor = E{}) : pixels_(map, executor) {}
    template <class E = SerialExecutor>
    explicit SheetReceiver(const EyePathMap<V>&&, E&& = E{}) = delete; // would refer to a temporary

    [[nodiscard]] const EyePathMap<V>& map() const { return pixels_.map(); }
    [[nodiscard]] const detail::ReceiverPixels<V>& pixels() const { return pixels_; }

private:
    detail::ReceiverPixels<V> pixels_;
};

/// Adds a lamp's caustics to the sums, as sheets between photons: for lamps with charts, and for scenes that draw no
/// random numbers, so that the point of emission determines a photon's path.
///
/// @param scene      as for `caustics`; `SheetAccount::by_chance` counts where it asked for a random number
/// @param light      one light or a set
/// @param sums       what is added to
/// @param receiver   optional: made of the sums' map
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
SheetStatistics light_sheets(const S& scene, const L& light, Sums<V, F, R>& sums, const SheetReceiver<V>& receiver,
                             const PhotonPass& pass, const SheetOptions& options = {}, E&& executor = E{},
                             TakeOver take_over = {}) {
    detail::check(pass, "nephroid::light_sheets");
    detail::check(options, "nephroid::light_sheets");
    if (&receiver.map() != &sums.map())
        invalid_argument("nephroid::light_sheets: the receiver is of another map than the sums; make it of sums.map()");
    detail::CheckedExecutor checked(executor);
    SheetStatistics statistics;
    if (sums.map().tree().empty())
        return statistics;
    const detail::ReceiverPixels<V>& pixels = receiver.pixels();
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

/// The same, for a receiver that is used once.
template <class S, class L, Vector3 V, Flux F, class R, class E = SerialExecutor, class TakeOver = DrawBroken>
SheetStatistics light_sheets(const S& scene, const L& light, Sums<V, F, R>& sums, const PhotonPass& pass,
                             const SheetOptions& options = {}, E&& executor = E{}, TakeOver take_over = {}) {
    detail::check(pass, "nephroid::light_sheets");
    detail::check(options, "nephroid::light_sheets");
    detail::CheckedExecutor checked(executor);
    return light_sheets(scene, light, sums, SheetReceiver<V>(sums.map(), checked), pass, options, executor,
                        std::move(take_over));
}

} // namespace nephroid
