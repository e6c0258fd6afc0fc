// SPDX-License-Identifier: MIT
/// @file  Light sheets where light lies on sheets, splats where it does not: one call for both.
#pragma once

#include "nephroid/caustics.hpp"
#include "nephroid/emission/chart/chart_light.hpp"
#include "nephroid/emission/light_set.hpp"
#include "nephroid/sheet/light_sheets.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace nephroid {

/// What became of the light that was drawn as sheets, and of the rest.
struct SheetsAndSplats {
    SheetStatistics sheets; ///< counts as splatted also what was handed over (`sheets.sheets.handed_over`)
    Statistics splats;      ///< of light that was handed over, and of lamps without charts. Both are traced again: an
                            ///< account by itself, not to be added to the other
};

namespace detail {
/// The pass that splats a part of the light, with as many photons as this part would get if all were splatted.
[[nodiscard]] inline PhotonPass pass_for(const PhotonPass& pass, double power, double whole_power) {
    const double share = whole_power > 0 ? power / whole_power : 1.0;
    PhotonPass part = pass;
    part.count = (std::max)(static_cast<std::uint64_t>(std::ceil(share * double(pass.count))), std::uint64_t(1));
    part.first = pass.first / pass.count * part.count;
    // From the rounded count, so that a part of a picture stays the same part of it.
    if (pass.total != 0)
        part.total = (std::max)(
            static_cast<std::uint64_t>(std::llround(double(part.count) * double(pass.total) / double(pass.count))),
            part.count);
    return part;
}

/// The lamps of a set that have no charts; of one lamp, that lamp.
template <class L>
[[nodiscard]] std::optional<L> without_charts(const L& light) {
    if constexpr (requires { light.lights(); }) {
        std::vector<typename L::AnyLight> without;
        for (const auto& any : light.lights())
            if (std::visit([](const auto& one) { return charts_of(one, 1).power_without > 0; }, any))
                without.push_back(any);
        return without.empty() ? std::nullopt : std::optional<L>(L(std::move(without)));
    } else {
        return charts_of(light, 1).power_without > 0 ? std::optional<L>(light) : std::nullopt;
    }
}
} // namespace detail

/// Adds a lamp's caustics to the sums: as light sheets where sheets can be drawn, and as splats elsewhere. Splatted are
/// the parts of a lamp's chart with more than a third of their light where sheets end (cut gems, foam), those where the
/// scene scatters by chance, and lamps without charts. No light is added twice, and none is left out.
///
/// ```cpp
/// auto sums = nephroid::sums<float>(map);
/// nephroid::sheet_caustics(scene, light, sums, {.count = 20'000}, {}, threads);
/// ```
///
/// @param scene, light, sums, executor  as for `caustics`
/// @param pass     about `count` photons make the sheets; light that is handed over is traced again, with its share of
///                 `count`. If several passes make one picture, all have the same `count`, and `first` is a multiple
///                 of it. `progress` can stop the splats only, and is told their photons: sheets are always complete
/// @param options  of the sheets
template <class S, class L, Vector3 V, Flux F, class R, class E = SerialExecutor>
SheetsAndSplats sheet_caustics(const S& scene, const L& light, Sums<V, F, R>& sums, const PhotonPass& pass,
                               const SheetOptions& options = {}, E&& executor = E{}) {
    struct Part {
        EmissionChart<V, F> chart;
        ChartRectangle rectangle;
    };
    std::vector<Part> parts;
    std::vector<ChartRectangle> of_chart;
    const EmissionChart<V, F>* at = nullptr;
    EmissionChart<V, F> chart;
    const auto finish_chart = [&] {
        for (const ChartRectangle& rectangle : merged(std::move(of_chart)))
            parts.push_back({chart, rectangle});
        of_chart.clear();
    };
    const auto take_over = [&](const EmissionChart<V, F>& from, const ChartRectangle& rectangle) {
        if (&from != at)
            finish_chart();
        at = &from;
        chart = from;
        of_chart.push_back(rectangle);
    };
    SheetsAndSplats result;
    result.sheets = light_sheets(scene, light, sums, pass, options, executor, take_over);
    finish_chart();

    using Lamp = ChartLight<V, F>;
    std::vector<std::variant<Lamp>> lamps;
    double power = 0;
    for (Part& part : parts) {
        lamps.push_back(Lamp(std::move(part.chart), part.rectangle));
        power += std::get<0>(lamps.back()).power();
    }
    double total = result.sheets.without_charts;
    for (const auto& any : charts_of(light, options.lamp_points).charts)
        total += any.power;
    bool goes_on = true;
    const auto splat = [&](const auto& lamp, double lamp_power) {
        PhotonPass share = detail::pass_for(pass, lamp_power, total);
        if (pass.progress)
            share.progress = [&](std::uint64_t done) { return goes_on = pass.progress(done); };
        result.splats += caustics(scene, lamp, sums, share, executor);
    };
    if (!lamps.empty())
        splat(LightSet<Lamp>(std::move(lamps)), power);
    if (const auto others = detail::without_charts(light); others && goes_on)
        splat(*others, result.sheets.without_charts);
    return result;
}

} // namespace nephroid
