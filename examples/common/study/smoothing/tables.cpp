// SPDX-License-Identifier: MIT
#include "common/study/smoothing/tables.hpp"

#include "common/study/equal.hpp"
#include "common/text.hpp"

#include <algorithm>
#include <cmath>

namespace nephroid::examples::study::smoothing {

namespace {

/// What the tables show. SSIM has two valleys by s, and its ratio says little.
constexpr std::array<Measure, 2> shown = {Measure::relative, Measure::rmse};

[[nodiscard]] Table table_by_photons(const std::vector<Case>& cases, std::string name, std::string title,
                                     std::string caption) {
    Table table{std::move(name), std::move(title), std::move(caption), {"case", "sequence"}, {}};
    for (const Trial& trial : cases.front().best)
        table.header.push_back(grouped(trial.wanted));
    return table;
}

[[nodiscard]] std::vector<std::string> row_of(const Case& one) { return {one.name, name_of(one.sequence)}; }

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
/// @param ratio_of  ratio_of(one, count, measure), an optional
template <class Ratio>
void add_summary(Table& table, const std::vector<Case>& cases, const Ratio& ratio_of) {
    std::vector<SequenceKind> sequences;
    for (const Case& one : cases)
        if (std::ranges::find(sequences, one.sequence) == sequences.end())
            sequences.push_back(one.sequence);
    for (const SequenceKind sequence : sequences) {
        std::vector<std::string> means = {"geometric mean", name_of(sequence)},
                                 largest = {"largest", name_of(sequence)};
        for (std::size_t count = 0; count < cases.front().best.size(); ++count) {
            Summary summary;
            for (const Case& one : cases)
                for (const Measure measure : shown)
                    if (const auto ratio = ratio_of(one, count, measure); ratio && one.sequence == sequence)
                        summary.add(measure, *ratio);
            means.push_back(pair_of([&](Measure m) { return summary.mean(m); }));
            largest.push_back(pair_of([&](Measure m) { return summary.largest(m); }));
        }
        table.rows.push_back(std::move(means));
        table.rows.push_back(std::move(largest));
    }
    Summary all;
    for (const Case& one : cases)
        for (std::size_t count = 0; count < one.best.size(); ++count)
            for (const Measure measure : shown)
                if (const auto ratio = ratio_of(one, count, measure))
                    all.add(measure, *ratio);
    table.caption += "; over all, mean " + pair_of([&](Measure m) { return all.mean(m); }) + " and largest " +
                     pair_of([&](Measure m) { return all.largest(m); });
}

[[nodiscard]] std::string slope_text(const std::vector<Trial>& trials, Measure measure) {
    const auto slope = slope_of(pointers(trials), measure);
    return slope ? text("%.2f", *slope) : "–";
}

} // namespace

Table equal_photons_table(const std::vector<Case>& cases) {
    Table table = table_by_photons(cases, "equal-photons", "Equal photons",
                                   "Error of second order, nothing chosen, over that of first "
                                   "order at the best s: rel / RMSE");
    for (const Case& one : cases) {
        table.rows.push_back(row_of(one));
        for (std::size_t count = 0; count < one.best.size(); ++count)
            table.rows.back().push_back(pair_of([&](Measure m) { return text("%.2f", ratio(one, count, m)); }));
    }
    add_summary(table, cases, [](const Case& one, std::size_t count, Measure measure) {
        return std::optional(ratio(one, count, measure));
    });
    return table;
}

Table equal_seconds_table(const std::vector<Case>& cases) {
    Table table = table_by_photons(cases, "equal-time", "Equal time",
                                   "The same over what first order at the best s comes to in the time that second "
                                   "order took for so many photons: rel / RMSE; ≥ where that is enough for more than "
                                   "the most photons tried");
    const auto reached = [](const Case& one, std::size_t count, Measure measure) {
        const double seconds = one.second[count].by(measure).timing.seconds.total();
        return reached_after(pointers(one.best), measure, seconds);
    };
    for (const Case& one : cases) {
        table.rows.push_back(row_of(one));
        for (std::size_t count = 0; count < one.best.size(); ++count)
            table.rows.back().push_back(pair_of([&](Measure measure) {
                const Reached first = reached(one, count, measure);
                const char* bound = "";
                if (first.bound == Bound::at_most)
                    bound = "≥ ";
                else if (first.bound == Bound::more_than)
                    bound = "≤ ";
                return bound + text("%.2f", one.second[count].cost(measure) / first.cost);
            }));
    }
    add_summary(table, cases, [&](const Case& one, std::size_t count, Measure measure) -> std::optional<double> {
        const Reached first = reached(one, count, measure);
        if (first.bound != Bound::within)
            return std::nullopt;
        return one.second[count].cost(measure) / first.cost;
    });
    return table;
}

Table slopes_table(const std::vector<Case>& cases, double fixed_smoothing) {
    Table table{
        "convergence",
        "Convergence",
        "Powers of the number of photons that errors fall with, by least squares: rel / RMSE",
        {"case", "sequence", "first order, best s", text("first order, s = %g", fixed_smoothing), "second order"},
        {}};
    for (const Case& one : cases) {
        std::vector<std::string> row = row_of(one);
        for (const auto* trials : {&one.best, &one.fixed, &one.second})
            row.push_back(pair_of([&](Measure measure) { return slope_text(*trials, measure); }));
        table.rows.push_back(std::move(row));
    }
    // Where variance is 1/s² or 1/s⁴ and bias s²/N or s⁴/N², each squared, least over s.
    table.rows.push_back({"theory, smooth", "halton", "-0.50", "0, then the pixels'", "-0.67"});
    table.rows.push_back({"theory, smooth", "random", "-0.33", "0, then the pixels'", "-0.40"});
    return table;
}

Table errors_table(const std::vector<Case>& cases) {
    Table table{
        "errors",
        "Errors",
        "Second order with nothing to choose; first order (published) at the s that is best by rel, RMSE and SSIM, "
        "which differs; seconds of second order, and of first order at the s that is best by rel",
        {"case", "sequence", "photons", "rel", "RMSE", "SSIM", "energy", "s", "published: best s", "rel", "RMSE",
         "SSIM", "s"},
        {}};
    for (const Case& one : cases)
        for (std::size_t count = 0; count < one.best.size(); ++count) {
            const Best& second = one.second[count].by(Measure::relative);
            const Trial& first = one.best[count];
            const auto errors_of = [&](Measure measure) {
                return error_text(value_of(first.by(measure).errors, measure));
            };
            const auto [least, most] =
                std::minmax({first.by(Measure::relative).bandwidth, first.by(Measure::rmse).bandwidth,
                             first.by(Measure::ssim).bandwidth});
            table.rows.push_back({one.name, name_of(one.sequence), grouped(first.wanted),
                                  error_text(second.errors.relative), error_text(second.errors.rmse),
                                  error_text(second.errors.ssim), text("%+.3f%%", 100 * second.errors.energy),
                                  text("%.2f", second.timing.seconds.total()),
                                  least == most ? text("%.3g", least) : text("%.3g to %.3g", least, most),
                                  errors_of(Measure::relative), errors_of(Measure::rmse), errors_of(Measure::ssim),
                                  text("%.2f", first.by(Measure::relative).timing.seconds.total())});
        }
    return table;
}

std::vector<std::string> table_names() { return {"equal-photons", "equal-time", "convergence", "errors"}; }

std::vector<Drawing> drawings(const std::vector<Case>& cases) {
    std::vector<Drawing> all;
    for (const Case& one : cases)
        for (const Measure measure : shown) {
            const std::string which = std::string(name_of(measure)) + "-" + one.name + "-" + name_of(one.sequence);
            Drawing drawing{"photons-" + which,
                            one.name + ", " + name_of(one.sequence) + " photons",
                            {"caustic photons", name_of(measure), true},
                            {}};
            drawing.axes.more = "set format x '%.0s%c'\n";
            std::size_t colour = 0;
            for (const auto& [title, trials] :
                 {std::pair{"first order, best s", &one.best}, std::pair{"first order, fixed s", &one.fixed},
                  std::pair{"second order", &one.second}}) {
                Curve curve{title, "", "linespoints lc rgb " + curve_colour(3 * colour++) + " lw 1.5 pt 7 ps 0.7"};
                for (const Trial& trial : *trials)
                    curve.data += positive_row({double(trial.wanted), trial.cost(measure)});
                drawing.curves.push_back(std::move(curve));
            }
            all.push_back(std::move(drawing));
        }
    return all;
}

} // namespace nephroid::examples::study::smoothing
