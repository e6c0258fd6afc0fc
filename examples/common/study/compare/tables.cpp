// SPDX-License-Identifier: MIT
#include "common/study/compare/tables.hpp"

#include "common/study/equal.hpp"
#include "common/text.hpp"

#include <algorithm>
#include <cmath>

namespace nephroid::examples::study::compare {

namespace {

[[nodiscard]] std::string sign(Bound bound) {
    return bound == Bound::within ? "" : bound == Bound::at_most ? "≤ " : "> ";
}

[[nodiscard]] std::string times(double ratio) { return text(ratio < 9.95 ? "%.1f×" : "%.0f×", ratio); }

/// "> 1 000 000 (> 50×)" or the like.
[[nodiscard]] std::string effort_text(const Effort& effort, double photons, double seconds, bool in_time) {
    const double value = in_time ? effort.seconds : effort.photons;
    const double ratio = in_time ? effort.seconds / seconds : effort.photons / photons;
    const std::string amount = in_time ? seconds_text(value) : grouped(std::uint64_t(std::llround(value)));
    return sign(effort.bound) + amount + " (" + sign(effort.bound) + times(ratio) + ")";
}

[[nodiscard]] const Trial* trial_at(const std::vector<const Trial*>& trials, std::uint64_t photons) {
    const auto found = std::ranges::find(trials, photons, &Trial::wanted);
    return found == trials.end() ? nullptr : *found;
}

[[nodiscard]] Table equal_error_table(const Options& options, const std::vector<Trial>& trials, const Trial& target,
                                      SequenceKind rivals) {
    Table table;
    table.name = "equal-error";
    table.title = "Equal error: " + std::string(target.method->id == "splat" ? "" : "second-order ") +
                  "splatting with " + name_of(target.sequence) + ", rivals with " + name_of(rivals);
    table.caption = "Photons and seconds to match " + target.method->title + " with " + grouped(target.wanted) + " " +
                    name_of(target.sequence) + " photons";
    table.header = {"method"};
    for (const Measure measure : measures) {
        const Best& best = target.by(measure);
        table.caption += std::string(measure == Measure::relative ? ": " : ", ") + name_of(measure) + " " +
                         error_text(value_of(best.errors, measure)) + " in " +
                         seconds_text(best.timing.seconds.total());
        table.header.push_back(std::string("photons, ") + name_of(measure));
        table.header.push_back(std::string("time, ") + name_of(measure));
    }
    for (const std::string& id : options.methods) {
        if (id == target.method->id && rivals == target.sequence)
            continue;
        const auto rival = trials_of(trials, id, rivals);
        std::vector<std::string> row = {find_method(id)->title};
        for (const Measure measure : measures) {
            const Effort effort = effort_for(rival, measure, target.cost(measure));
            const double seconds = target.by(measure).timing.seconds.total();
            row.push_back(effort_text(effort, double(target.wanted), seconds, false));
            row.push_back(effort_text(effort, double(target.wanted), seconds, true));
        }
        table.rows.push_back(std::move(row));
    }
    return table;
}

[[nodiscard]] double value_of_cost(double cost, Measure measure) { return measure == Measure::ssim ? 1 - cost : cost; }

[[nodiscard]] std::string reached_text(const Reached& reached, double target, Measure measure) {
    if (reached.bound == Bound::more_than)
        return "too slow";
    const bool is_bound = reached.bound == Bound::at_most;
    const std::string at_most = is_bound ? "≤ " : "", value = is_bound && measure == Measure::ssim ? "≥ " : at_most;
    return value + error_text(value_of_cost(reached.cost, measure)) + " (" + at_most + times(reached.cost / target) +
           ")";
}

[[nodiscard]] Table equal_time_table(const Options& options, const std::vector<Trial>& trials, const Trial& target) {
    Table table;
    table.name = "equal-time";
    table.title = "Equal time: " + grouped(target.wanted) + " " + name_of(target.sequence) + " photons splatted";
    table.caption = "What each method reaches in the time that photon differential splatting takes, and how many times "
                    "its error that is (of SSIM: its distance from 1)";
    table.header = {"method"};
    std::vector<std::string> own = {find_method("splat")->title};
    for (const Measure measure : measures) {
        const Best& best = target.by(measure);
        table.header.push_back(std::string(name_of(measure)) + " in " + seconds_text(best.timing.seconds.total()));
        own.push_back(error_text(value_of(best.errors, measure)));
    }
    table.rows.push_back(std::move(own));
    for (const std::string& id : options.methods) {
        if (id == "splat")
            continue;
        const auto rival = trials_of(trials, id, target.sequence);
        std::vector<std::string> row = {find_method(id)->title};
        for (const Measure measure : measures) {
            const double seconds = target.by(measure).timing.seconds.total();
            row.push_back(reached_text(reached_after(rival, measure, seconds), target.cost(measure), measure));
        }
        table.rows.push_back(std::move(row));
    }
    return table;
}

[[nodiscard]] bool is_compared_with_splat(const Options& options) {
    return options.methods.size() > 1 && std::ranges::find(options.methods, "splat") != options.methods.end();
}

} // namespace

std::vector<std::string> table_names() {
    std::vector<std::string> names = {"equal-error", "equal-time", "convergence"};
    for (const Measure measure : measures)
        names.push_back(std::string("best-") + name_of(measure));
    return names;
}

std::vector<Table> equal_error_tables(const Options& options, const std::vector<Trial>& trials) {
    std::vector<Table> tables;
    if (!is_compared_with_splat(options))
        return tables;
    for (std::size_t own = 0; own < options.sequences.size(); ++own)
        for (std::size_t rivals = own; rivals < options.sequences.size(); ++rivals)
            for (const char* id : {"splat", "splat-auto"})
                if (const Trial* target =
                        trial_at(trials_of(trials, id, options.sequences[own]), target_photons(options)))
                    tables.push_back(equal_error_table(options, trials, *target, options.sequences[rivals]));
    return tables;
}

std::vector<Table> equal_time_tables(const Options& options, const std::vector<Trial>& trials) {
    std::vector<Table> tables;
    if (!is_compared_with_splat(options))
        return tables;
    for (const SequenceKind sequence : options.sequences)
        for (const Trial* target : trials_of(trials, "splat", sequence))
            tables.push_back(equal_time_table(options, trials, *target));
    return tables;
}

Table slope_table(const Options& options, const std::vector<Trial>& trials) {
    Table table{"convergence",
                "Convergence",
                "The power of the number of photons that each error falls with, at the best bandwidth for each number "
                "(of SSIM: its distance from 1), by least squares",
                {"method"},
                {}};
    for (const SequenceKind sequence : options.sequences)
        for (const Measure measure : measures)
            table.header.push_back(std::string(name_of(measure)) + ", " + name_of(sequence));
    for (const std::string& id : options.methods) {
        std::vector<std::string> row = {find_method(id)->title};
        for (const SequenceKind sequence : options.sequences)
            for (const Measure measure : measures) {
                const auto slope = slope_of(trials_of(trials, id, sequence), measure);
                row.push_back(slope ? text("%.2f", *slope) : "–");
            }
        table.rows.push_back(std::move(row));
    }
    return table;
}

Table best_table(const std::vector<Trial>& trials, Measure measure) {
    Table table{
        std::string("best-") + name_of(measure),
        std::string("Best bandwidths by ") + name_of(measure),
        "Seconds are the run with the median total; the spread is from the fastest run to the slowest. Memory is "
        "the peak beyond the eye path vertices and the picture",
        {"sequence", "photons", "method", "bandwidth", "rel", "RMSE", "SSIM", "energy", "trace", "build", "estimate",
         "total", "spread", "photons/s", "memory"},
        {}};
    for (const Trial& trial : trials) {
        const Best& best = trial.by(measure);
        const Seconds& seconds = best.timing.seconds;
        table.rows.push_back({name_of(trial.sequence), grouped(trial.wanted), trial.method->title,
                              bandwidth_text(*best.method, best.bandwidth), error_text(best.errors.relative),
                              error_text(best.errors.rmse), error_text(best.errors.ssim),
                              text("%+.3f%%", 100 * best.errors.energy), text("%.3f", seconds.trace),
                              text("%.3f", seconds.build), text("%.3f", seconds.estimate),
                              seconds_text(seconds.total()), text("%.3f–%.3f", best.timing.least, best.timing.most),
                              text("%.2f M", double(trial.emitted) / seconds.total() * 1e-6),
                              best.timing.memory ? text("%.1f MB", *best.timing.memory * 1e-6) : "–"});
    }
    return table;
}

} // namespace nephroid::examples::study::compare
