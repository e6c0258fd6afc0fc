// SPDX-License-Identifier: MIT
#include "common/study/compare/plots.hpp"

#include "common/study/equal.hpp"
#include "common/text.hpp"

#include <algorithm>

namespace nephroid::examples::study::compare {

namespace {

[[nodiscard]] std::string cost_name(Measure measure) {
    return measure == Measure::ssim ? "1 − SSIM" : measure == Measure::rmse ? "clipped RMSE" : "rel";
}

/// A method's look, by its place in `methods()`: the first one stands out.
[[nodiscard]] std::string look_of(const Method& method, const std::string& style) {
    const auto place = std::size_t(&method - methods().data());
    return style + " lc rgb " + curve_colour(place) + " lw " + (place == 0 ? "3" : "1.5") + " pt " +
           std::to_string(place == 0 ? 7 : 4 + place % 10) + " ps 0.7";
}

[[nodiscard]] Drawing time_plot(const Options& options, const std::vector<Trial>& trials, SequenceKind sequence,
                                Measure measure) {
    Drawing drawing{{}, "time", {"seconds (bars: fastest and slowest run)", cost_name(measure), true, "1:2:3:4"}, {}};
    for (const std::string& id : options.methods) {
        Curve curve{id, "", look_of(*find_method(id), "xerrorlines")};
        for (const Trial* trial : trials_of(trials, id, sequence)) {
            const Timing& timing = trial->by(measure).timing;
            curve.data += positive_row({timing.seconds.total(), trial->cost(measure), timing.least, timing.most});
        }
        drawing.curves.push_back(std::move(curve));
    }
    return drawing;
}

[[nodiscard]] Drawing photon_plot(const Options& options, const std::vector<Trial>& trials, SequenceKind sequence,
                                  Measure measure) {
    Drawing drawing{{}, "the number of photons", {"caustic photons (slope in brackets)", cost_name(measure), true}, {}};
    drawing.axes.more = "set format x '%.0s%c'\n";
    for (const std::string& id : options.methods) {
        const auto own = trials_of(trials, id, sequence);
        const auto slope = slope_of(own, measure);
        Curve curve{id + (slope ? text(" (%.2f)", *slope) : ""), "", look_of(*find_method(id), "linespoints")};
        for (const Trial* trial : own)
            curve.data += positive_row({double(trial->wanted), trial->cost(measure)});
        drawing.curves.push_back(std::move(curve));
    }
    return drawing;
}

[[nodiscard]] Drawing bandwidth_plot(const Options& options, const std::vector<Trial>& trials, SequenceKind sequence,
                                     Measure measure) {
    Drawing drawing{{},
                    "bandwidth, " + grouped(options.photons.front()),
                    {"bandwidth over the one with the least rel (named below)", cost_name(measure), true},
                    {}};
    for (const std::string& id : options.methods) {
        const Method& method = *find_method(id);
        const Trial& trial = *trials_of(trials, id, sequence).front();
        const Best& best = trial.by(Measure::relative);
        const std::string chosen = method.symbol.empty() ? "" : ", " + bandwidth_text(*best.method, best.bandwidth);
        Curve curve{id + chosen, "", look_of(method, "linespoints")};
        for (const auto& [bandwidth, errors] : std::ranges::find(trial.sweeps, best.method, &Sweep::method)->errors)
            curve.data += positive_row({bandwidth / best.bandwidth, cost_of(errors, measure)});
        drawing.curves.push_back(std::move(curve));
    }
    return drawing;
}

} // namespace

std::vector<Drawing> drawings(const Options& options, const std::vector<Trial>& trials) {
    std::vector<Drawing> all;
    using Draw = Drawing (*)(const Options&, const std::vector<Trial>&, SequenceKind, Measure);
    const auto add = [&](const std::string& kind, Draw draw) {
        for (const Measure measure : measures)
            for (const SequenceKind sequence : options.sequences) {
                Drawing drawing = draw(options, trials, sequence, measure);
                drawing.name = kind + "-" + name_of(measure) + "-" + name_of(sequence);
                drawing.title =
                    cost_name(measure) + " against " + drawing.title + ", " + name_of(sequence) + " photons";
                all.push_back(std::move(drawing));
            }
    };
    add("time", time_plot);
    if (options.photons.size() > 1)
        add("photons", photon_plot);
    add("bandwidth", bandwidth_plot);
    return all;
}

} // namespace nephroid::examples::study::compare
