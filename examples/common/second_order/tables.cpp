// SPDX-License-Identifier: MIT
#include "common/second_order/tables.hpp"

#include "common/compare/equal.hpp"
#include "common/text.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>

namespace nephroid::examples::second_order {

namespace {

/// What the tables show. SSIM has two valleys by s, and its ratio says little.
constexpr std::array<Measure, 2> shown = {Measure::relative, Measure::rmse};

[[nodiscard]] Table table_by_photons(const std::vector<Study>& studies, std::string title, std::string caption) {
    Table table{std::move(title), std::move(caption), {"case", "sequence"}, {}};
    for (const Trial& trial : studies.front().best)
        table.header.push_back(grouped(trial.wanted));
    return table;
}

[[nodiscard]] std::vector<std::string> row_of(const Study& study) { return {study.name, name_of(study.sequence)}; }

/// "0.56 / 0.71", one for each measure.
template <class Text>
[[nodiscard]] std::string pair_of(const Text& text_of) {
    std::string cell;
    for (const Measure measure : shown)
        cell += (cell.empty() ? "" : " / ") + std::string(text_of(measure));
    return cell;
}

/// The geometric mean and the largest of some ratios, measure by measure.
class Summary {
public:
    void add(Measure measure, double ratio) {
        Sum& sum = sums_[std::size_t(measure)];
        sum.logs += std::log(ratio);
        sum.count += 1;
        sum.largest = (std::max)(sum.largest, ratio);
    }
    /// "0.65", or a dash where there were none.
    [[nodiscard]] std::string mean(Measure measure) const {
        const Sum& sum = sums_[std::size_t(measure)];
        return sum.count > 0 ? text("%.2f", std::exp(sum.logs / sum.count)) : "–";
    }
    [[nodiscard]] std::string largest(Measure measure) const {
        const Sum& sum = sums_[std::size_t(measure)];
        return sum.count > 0 ? text("%.2f", sum.largest) : "–";
    }

private:
    struct Sum {
        double logs = 0, count = 0, largest = 0;
    };
    std::array<Sum, measures.size()> sums_{};
};

/// Rows "geometric mean" and "largest" for each sequence, over all of its cases.
///
/// @param ratio_of  ratio_of(study, count, measure), an optional
template <class Ratio>
void add_summary(Table& table, const std::vector<Study>& studies, const Ratio& ratio_of) {
    std::vector<SequenceKind> sequences;
    for (const Study& study : studies)
        if (std::ranges::find(sequences, study.sequence) == sequences.end())
            sequences.push_back(study.sequence);
    for (const SequenceKind sequence : sequences) {
        std::vector<std::string> means = {"geometric mean", name_of(sequence)},
                                 largest = {"largest", name_of(sequence)};
        for (std::size_t count = 0; count < studies.front().best.size(); ++count) {
            Summary summary;
            for (const Study& study : studies)
                for (const Measure measure : shown)
                    if (const auto ratio = ratio_of(study, count, measure); ratio && study.sequence == sequence)
                        summary.add(measure, *ratio);
            means.push_back(pair_of([&](Measure m) { return summary.mean(m); }));
            largest.push_back(pair_of([&](Measure m) { return summary.largest(m); }));
        }
        table.rows.push_back(std::move(means));
        table.rows.push_back(std::move(largest));
    }
    Summary all;
    for (const Study& study : studies)
        for (std::size_t count = 0; count < study.best.size(); ++count)
            for (const Measure measure : shown)
                if (const auto ratio = ratio_of(study, count, measure))
                    all.add(measure, *ratio);
    table.caption += "; over all, mean " + pair_of([&](Measure m) { return all.mean(m); }) + " and largest " +
                     pair_of([&](Measure m) { return all.largest(m); });
}

[[nodiscard]] std::string slope_text(const std::vector<Trial>& trials, Measure measure) {
    const auto slope = slope_of(pointers(trials), measure);
    return slope ? text("%.2f", *slope) : "–";
}

} // namespace

Table equal_photons_table(const std::vector<Study>& studies) {
    Table table = table_by_photons(studies, "Equal photons",
                                   "Error of second order, nothing chosen, over that of first "
                                   "order at the best s: rel / RMSE");
    for (const Study& study : studies) {
        table.rows.push_back(row_of(study));
        for (std::size_t count = 0; count < study.best.size(); ++count)
            table.rows.back().push_back(pair_of([&](Measure m) { return text("%.2f", ratio(study, count, m)); }));
    }
    add_summary(table, studies, [](const Study& study, std::size_t count, Measure measure) {
        return std::optional(ratio(study, count, measure));
    });
    return table;
}

Table equal_seconds_table(const std::vector<Study>& studies) {
    Table table = table_by_photons(studies, "Equal time",
                                   "The same over what first order at the best s comes to in the time that second "
                                   "order took for so many photons: rel / RMSE; ≥ where that is enough for more than "
                                   "the most photons tried");
    const auto reached = [](const Study& study, std::size_t count, Measure measure) {
        const double seconds = study.second[count].by(measure).timing.seconds.total();
        return reached_after(pointers(study.best), measure, seconds);
    };
    for (const Study& study : studies) {
        table.rows.push_back(row_of(study));
        for (std::size_t count = 0; count < study.best.size(); ++count)
            table.rows.back().push_back(pair_of([&](Measure measure) {
                const Reached first = reached(study, count, measure);
                const char* bound = "";
                if (first.bound == Bound::at_most)
                    bound = "≥ ";
                else if (first.bound == Bound::more_than)
                    bound = "≤ ";
                return bound + text("%.2f", study.second[count].cost(measure) / first.cost);
            }));
    }
    add_summary(table, studies, [&](const Study& study, std::size_t count, Measure measure) -> std::optional<double> {
        const Reached first = reached(study, count, measure);
        if (first.bound != Bound::within)
            return std::nullopt;
        return study.second[count].cost(measure) / first.cost;
    });
    return table;
}

Table slopes_table(const std::vector<Study>& studies, double fixed_smoothing) {
    Table table{
        "Convergence",
        "Powers of the number of photons that errors fall with, by least squares: rel / RMSE",
        {"case", "sequence", "first order, best s", text("first order, s = %g", fixed_smoothing), "second order"},
        {}};
    for (const Study& study : studies) {
        std::vector<std::string> row = row_of(study);
        for (const auto* trials : {&study.best, &study.fixed, &study.second})
            row.push_back(pair_of([&](Measure measure) { return slope_text(*trials, measure); }));
        table.rows.push_back(std::move(row));
    }
    // Where variance is 1/s² or 1/s⁴ and bias s²/N or s⁴/N², each squared, least over s.
    table.rows.push_back({"theory, smooth", "halton", "-0.50", "0, then the pixels'", "-0.67"});
    table.rows.push_back({"theory, smooth", "random", "-0.33", "0, then the pixels'", "-0.40"});
    return table;
}

void print_markdown(std::ostream& out, const Table& table) {
    const auto write = [&](const std::vector<std::string>& row) {
        for (const std::string& cell : row)
            out << "| " << cell << ' ';
        out << "|\n";
    };
    out << "\n" << table.title << ". " << table.caption << ".\n\n";
    write(table.header);
    write(std::vector<std::string>(table.header.size(), "---"));
    for (const auto& row : table.rows)
        write(row);
}

std::string csv_text(const std::vector<Study>& studies) {
    std::string csv =
        "case,sequence,photons,emitted,splatting,measure,s,rel,rmse,ssim,energy,trace_seconds,build_seconds,"
        "estimate_seconds\n";
    for (const Study& study : studies)
        for (const auto& [name, trials] : {std::pair{"first-best", &study.best}, std::pair{"first-fixed", &study.fixed},
                                           std::pair{"second", &study.second}})
            for (const Trial& trial : *trials)
                for (const Measure measure : measures) {
                    const Best& best = trial.by(measure);
                    csv += study.name + "," + name_of(study.sequence) + "," + std::to_string(trial.wanted) + "," +
                           std::to_string(trial.emitted) + "," + name + "," + name_of(measure) +
                           text(",%.4g,%.6g,%.6g,%.6g,%.3g,%.4g,%.4g,%.4g\n", best.bandwidth, best.errors.relative,
                                best.errors.rmse, best.errors.ssim, best.errors.energy, best.timing.seconds.trace,
                                best.timing.seconds.build, best.timing.seconds.estimate);
                }
    return csv;
}

} // namespace nephroid::examples::second_order
