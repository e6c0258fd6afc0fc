// SPDX-License-Identifier: MIT
#include "common/study/relax/tables.hpp"

#include "common/text.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace nephroid::examples::study::relax {

namespace {

struct Row {
    const char* map;
    const Look* look;
};

[[nodiscard]] std::vector<Row> rows_of(const BeforeAndAfter& measured) {
    std::vector<Row> rows;
    for (const Look& look : measured.before.looks)
        rows.push_back({"unrelaxed", &look});
    if (measured.before.best) {
        rows.push_back({"best rel", &*measured.before.best});
        rows.push_back({"best RMSE", &*measured.before.best_picture});
    }
    for (const Look& look : measured.after.looks)
        rows.push_back({"relaxed", &look});
    return rows;
}

[[nodiscard]] TableRow cells_of(const Row& row, bool has_truth) {
    TableRow cells{row.map, std::to_string(row.look->neighbours), text("%.3f", row.look->seconds)};
    if (has_truth) {
        const Errors errors = row.look->errors.value_or(Errors{NAN, NAN, NAN, NAN});
        for (const double error : {errors.relative, errors.rmse, errors.ssim})
            cells.push_back(text("%.4f", error));
        cells.push_back(text("%+.2f%%", 100 * errors.energy));
    }
    for (const double width : row.look->edge_widths)
        cells.push_back(std::isfinite(width) ? text("%.5f", width) : "–");
    return cells;
}

[[nodiscard]] TableRow cells_of(const char* map, const BlueNoise& noise) {
    return {map, text("%.1f", noise.principal), text("%.2f", decibels(noise.low_power)),
            text("%.2f", decibels(noise.anisotropy)), text("%.2f", decibels(noise.worst_anisotropy))};
}

} // namespace

Table errors_table(const Options& options, const Subject& subject, const BeforeAndAfter& measured) {
    const RelaxationReport& report = measured.relaxation;
    const double iterated = static_cast<double>(report.photons) * (std::max)(1u, report.iterations);
    Table table{
        "errors", options.subject + ", " + grouped(report.photons) + " photons", "", {"map", "k", "seconds"}, {}};
    table.caption =
        text("%zu x %zu pixels, %u thread%s; %u iterations in %.3f s (%.3f us per photon and iteration), %zu "
             "feature searches, %.1f%% of the photons held; map built in %.3f s before and %.3f s after",
             subject.width, subject.height, measured.threads, measured.threads == 1 ? "" : "s", report.iterations,
             measured.relaxation_seconds, 1e6 * measured.relaxation_seconds / iterated, report.feature_searches,
             100 * static_cast<double>(report.constrained_photons) / static_cast<double>(report.photons),
             measured.before.build_seconds, measured.after.build_seconds);
    if (!subject.edges.empty())
        table.caption += "; the last columns are the edges' widths from 10% to 90%";
    if (subject.truth)
        for (const char* name : {"rel", "RMSE", "SSIM", "energy"})
            table.header.emplace_back(name);
    for (const Edge& edge : subject.edges)
        table.header.push_back(edge.name);
    for (const Row& row : rows_of(measured))
        table.rows.push_back(cells_of(row, subject.truth.has_value()));
    return table;
}

Table spectrum_table(const BeforeAndAfter& measured) {
    Table table{
        "spectrum",
        "Spectrum of the photons",
        "The principal frequency in cycles per window; decibels over white noise: the mean power below half of it, "
        "the mean anisotropy up to twice of it, and the largest of those annuli that have 64 frequencies",
        {"map", "principal", "low power/dB", "anisotropy/dB", "worst/dB"},
        {}};
    if (measured.before.blue_noise && measured.after.blue_noise)
        table.rows = {cells_of("unrelaxed", *measured.before.blue_noise),
                      cells_of("relaxed", *measured.after.blue_noise)};
    return table;
}

std::optional<TableRow> verdict_row(const Options& options, const BeforeAndAfter& measured) {
    if (!measured.before.best || !measured.before.best_picture)
        return std::nullopt;
    const auto distance = [](const Look& look) { return std::abs(static_cast<double>(look.neighbours) - 20); };
    const Look& relaxed = *std::ranges::min_element(measured.after.looks, {}, distance);
    const Look &best = *measured.before.best, &best_picture = *measured.before.best_picture;
    if (!relaxed.errors || !best.errors || !best_picture.errors)
        return std::nullopt;
    return TableRow{options.subject,
                    grouped(measured.relaxation.photons),
                    name_of(options.sequence),
                    std::to_string(relaxed.neighbours),
                    text("%.3f", relaxed.errors->relative / best.errors->relative),
                    text("%.3f", relaxed.errors->rmse / best_picture.errors->rmse),
                    text("%zu, %zu", best.neighbours, best_picture.neighbours),
                    text("%.2f, %.2f", best.seconds / relaxed.seconds, best_picture.seconds / relaxed.seconds)};
}

Table verdict_table(std::vector<TableRow> rows) {
    return {"verdict",
            "Relaxed against the unrelaxed map's best",
            "Errors of the relaxed map with few neighbours over those of the unrelaxed one with the k that is best for "
            "each "
            "measure: below 1 relaxing wins; and how many times its render time that best k takes",
            {"subject", "photons", "sequence", "k", "rel", "RMSE", "best k by rel, RMSE", "their render time"},
            std::move(rows)};
}

std::vector<std::string> table_names() { return {"errors", "spectrum", "verdict", "cost"}; }

std::string csv_text(const Subject& subject, const BeforeAndAfter& measured) {
    std::string csv = "map,neighbours,seconds,rel,RMSE,SSIM,energy";
    for (const Edge& edge : subject.edges)
        csv += "," + edge.name + " width";
    csv += "\n";
    const auto number = [](double value) { return std::isfinite(value) ? text(",%.6g", value) : std::string(","); };
    for (const Row& row : rows_of(measured)) {
        const Errors unknown{NAN, NAN, NAN, NAN}, &errors = row.look->errors ? *row.look->errors : unknown;
        csv += row.map + text(",%zu", row.look->neighbours) + number(row.look->seconds) + number(errors.relative) +
               number(errors.rmse) + number(errors.ssim) + number(errors.energy);
        for (const double width : row.look->edge_widths)
            csv += number(width);
        csv += "\n";
    }
    return csv;
}

} // namespace nephroid::examples::study::relax
