// SPDX-License-Identifier: MIT
#include "common/study/trial.hpp"

#include "common/memory.hpp"
#include "common/study/bench.hpp"
#include "common/text.hpp"

#include <algorithm>
#include <cmath>

namespace nephroid::examples::study {

namespace {

/// Repeating ends when it has taken so long.
constexpr double enough_seconds = 6;
/// How far from the expected bandwidth a curve is drawn, in points of the grid: eight times more and less in radius.
constexpr int curve_reach = 12;

[[nodiscard]] Timing median_of(std::vector<Seconds> runs) {
    std::ranges::sort(runs, {}, &Seconds::total);
    Timing timing;
    timing.seconds = runs[runs.size() / 2];
    timing.least = runs.front().total();
    timing.most = runs.back().total();
    timing.repeats = static_cast<unsigned>(runs.size());
    return timing;
}

/// Makes the picture from the lamp on, several times.
[[nodiscard]] Best measured(const Bench& bench, const Method& method, const Photons& photons, double bandwidth,
                            unsigned repeats) {
    Best best;
    best.method = &method;
    best.bandwidth = bandwidth;
    std::vector<Seconds> runs;
    std::optional<double> memory;
    for (double spent = 0; runs.empty() || (runs.size() < repeats && spent < enough_seconds);) {
        const MemoryPeak peak;
        Estimate estimate = method.run(bench, photons, bandwidth, Source::lamp);
        if (runs.empty()) {
            memory = peak.bytes();
            best.irradiance = std::move(estimate.irradiance);
        }
        runs.push_back(estimate.seconds);
        spent += estimate.seconds.total();
    }
    best.errors = bench.errors(best.irradiance);
    best.timing = median_of(std::move(runs));
    best.timing.memory = memory;
    return best;
}

/// What is best by a measure so far.
struct Choice {
    const Method* method = nullptr;
    double bandwidth = 0, cost = 0;
};

[[nodiscard]] Sweep swept(const Options& options, const Bench& bench, const Method& method, const Photons& photons,
                          std::array<Choice, measures.size()>& choices) {
    BandwidthSweep sweep({method.expected(bench, photons), method.least(bench, photons), method.most(bench, photons),
                          method.ratio, method.is_whole},
                         [&](double bandwidth) {
                             return bench.errors(method.run(bench, photons, bandwidth, Source::stored).irradiance);
                         });
    if (options.sweep && photons.wanted == options.photons.front())
        sweep.cover(curve_reach);
    for (const Measure measure : measures) {
        Choice& best = choices[std::size_t(measure)];
        const double bandwidth = sweep.best(measure);
        const double cost = cost_of(sweep.evaluated().at(bandwidth), measure);
        if (!best.method || cost < best.cost)
            best = {&method, bandwidth, cost};
    }
    return {&method, sweep.evaluated()};
}

[[nodiscard]] Trial trial_of(const Method& method, const Photons& photons) {
    Trial trial;
    trial.method = &method;
    trial.sequence = photons.sequence;
    trial.wanted = photons.wanted;
    trial.caustic = photons.deposits.size();
    trial.emitted = photons.emitted;
    return trial;
}

} // namespace

Trial tried(const Options& options, const Bench& bench, const Method& method, const Photons& photons) {
    Trial trial = trial_of(method, photons);
    std::array<Choice, measures.size()> choices;
    trial.sweeps.push_back(swept(options, bench, method, photons, choices));
    for (const Method& setting : method.settings)
        trial.sweeps.push_back(swept(options, bench, setting, photons, choices));
    photons.diffusion.reset(); // not to be counted as another method's memory
    for (const Measure measure : measures) {
        const auto [chosen, bandwidth, cost] = choices[std::size_t(measure)];
        const auto end = trial.best.begin() + std::ptrdiff_t(measure);
        const auto same = std::find_if(trial.best.begin(), end, [&, m = chosen, h = bandwidth](const Best& best) {
            return best.method == m && best.bandwidth == h;
        });
        trial.best[std::size_t(measure)] =
            same != end ? *same : measured(bench, *chosen, photons, bandwidth, options.repeats);
    }
    return trial;
}

Trial tried_at(const Bench& bench, const Method& method, const Photons& photons, double bandwidth) {
    Trial trial = trial_of(method, photons);
    Estimate estimate = method.run(bench, photons, bandwidth, Source::stored);
    Best best;
    best.method = &method;
    best.bandwidth = bandwidth;
    best.errors = bench.errors(estimate.irradiance);
    best.timing = {estimate.seconds, estimate.seconds.total(), estimate.seconds.total(), 1, {}};
    best.irradiance = std::move(estimate.irradiance);
    trial.best.fill(best);
    trial.sweeps.push_back({&method, {{bandwidth, best.errors}}});
    return trial;
}

std::vector<Trial> all_trials(const Options& options, const Bench& bench, const std::function<void(Trial&)>& done) {
    std::vector<Trial> trials;
    for (const SequenceKind sequence : options.sequences)
        for (const std::uint64_t wanted : options.photons) {
            const Photons photons = bench.trace(sequence, wanted);
            for (const std::string& id : options.methods) {
                trials.push_back(tried(options, bench, *find_method(id), photons));
                done(trials.back());
            }
        }
    return trials;
}

std::vector<const Trial*> trials_of(const std::vector<Trial>& trials, const std::string& method,
                                    SequenceKind sequence) {
    std::vector<const Trial*> found;
    for (const Trial& trial : trials)
        if (trial.method->id == method && trial.sequence == sequence)
            found.push_back(&trial);
    std::ranges::sort(found, {}, &Trial::wanted);
    return found;
}

std::uint64_t target_photons(const Options& options) {
    constexpr std::uint64_t papers = 20'000;
    return std::ranges::find(options.photons, papers) != options.photons.end() ? papers : options.photons.front();
}

std::string error_text(double value) { return std::isfinite(value) ? text("%.4f", value) : "–"; }

std::string seconds_text(double seconds) {
    return text(seconds < 0.995 ? "%.3f s" : seconds < 9.95 ? "%.2f s" : "%.1f s", seconds);
}

std::string summary(const Trial& trial) {
    std::string line =
        text("%-7s %9s  %-19s", name_of(trial.sequence), grouped(trial.wanted).c_str(), trial.method->id.c_str());
    for (const Measure measure : measures) {
        const Best& best = trial.by(measure);
        line += text("  %s %.4f (%s, %.3f s)", name_of(measure), value_of(best.errors, measure),
                     bandwidth_text(*best.method, best.bandwidth).c_str(), best.timing.seconds.total());
    }
    return line;
}

} // namespace nephroid::examples::study
