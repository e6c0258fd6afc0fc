// SPDX-License-Identifier: MIT
#include "common/relaxation/table.hpp"

#include "common/text.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>

namespace nephroid::examples::relaxation {

namespace {

struct Row {
    const char* map;
    const Look* look;
};

[[nodiscard]] std::vector<Row> rows_of(const Study& study) {
    std::vector<Row> rows;
    for (const Look& look : study.before.looks)
        rows.push_back({"unrelaxed", &look});
    if (study.before.best) {
        rows.push_back({"best rel", &*study.before.best});
        rows.push_back({"best RMSE", &*study.before.best_picture});
    }
    for (const Look& look : study.after.looks)
        rows.push_back({"relaxed", &look});
    return rows;
}

void print_row(std::ostream& out, const Row& row) {
    out << text("  %-10s %6zu %9.3f", row.map, row.look->neighbours, row.look->seconds);
    if (row.look->errors) {
        const Errors& errors = *row.look->errors;
        out << text(" %8.4f %8.4f %8.4f %+8.2f%%", errors.relative, errors.rmse, errors.ssim, 100 * errors.energy);
    }
    for (const double width : row.look->edge_widths)
        out << text(" %9.5f", width);
    out << '\n';
}

void print_noise(std::ostream& out, const char* map, const BlueNoise& noise) {
    out << text("  %-16s %9.1f %12.2f %14.2f %14.2f\n", map, noise.principal, decibels(noise.low_power),
                decibels(noise.anisotropy), decibels(noise.worst_anisotropy));
}

/// The relaxed map with 20 neighbours, the paper's number, or the nearest to it, against the unrelaxed map's best.
void print_verdict(std::ostream& out, const Study& study) {
    const auto distance = [](const Look& look) { return std::abs(static_cast<double>(look.neighbours) - 20); };
    const Look& relaxed = *std::ranges::min_element(study.after.looks, {}, distance);
    const Look &best = *study.before.best, &best_picture = *study.before.best_picture;
    if (!relaxed.errors || !best.errors || !best_picture.errors)
        return;
    out << text("relaxed with %zu neighbours against the unrelaxed map's best:\n", relaxed.neighbours)
        << text("  %.3f times its rel in 1/%.2f of the render time (%zu neighbours)\n",
                relaxed.errors->relative / best.errors->relative, best.seconds / relaxed.seconds, best.neighbours)
        << text("  %.3f times its RMSE in 1/%.2f of the render time (%zu neighbours)\n",
                relaxed.errors->rmse / best_picture.errors->rmse, best_picture.seconds / relaxed.seconds,
                best_picture.neighbours);
}

} // namespace

void print_table(std::ostream& out, const Options& options, const Subject& subject, const Study& study) {
    const RelaxationReport& report = study.relaxation;
    const double photons = static_cast<double>(report.photons);
    out << "relaxation " << options.subject << ", " << grouped(report.photons) << " photons, "
        << text("%zu x %zu, %u thread%s\n", subject.width, subject.height, study.threads,
                study.threads == 1 ? "" : "s");
    for (const std::string& note : subject.notes)
        out << "note: " << note << '\n';
    out << text(
        "%u iterations in %.3f s (%.3f us per photon and iteration), %zu feature searches, %.1f%% of the photons "
        "held\n",
        report.iterations, study.relaxation_seconds,
        report.iterations > 0 ? 1e6 * study.relaxation_seconds / photons / report.iterations : 0,
        report.feature_searches, 100 * static_cast<double>(report.constrained_photons) / photons);
    out << text("map built in %.3f s before and %.3f s after\n", study.before.build_seconds, study.after.build_seconds);

    out << text("  %-10s %6s %9s", "map", "k", "seconds");
    if (subject.truth)
        out << text(" %8s %8s %8s %9s", "rel", "RMSE", "SSIM", "energy");
    for (const Edge& edge : subject.edges)
        out << text(" %9s", edge.name.c_str());
    out << '\n';
    for (const Row& row : rows_of(study))
        print_row(out, row);
    if (!subject.edges.empty())
        out << "  (the last columns: the edges' widths from 10% to 90%)\n";
    if (study.before.best)
        print_verdict(out, study);
    if (study.before.blue_noise && study.after.blue_noise) {
        out << text("  %-16s %9s %12s %14s %14s\n", "spectrum", "principal", "low power/dB", "anisotropy/dB",
                    "worst/dB");
        print_noise(out, "unrelaxed", *study.before.blue_noise);
        print_noise(out, "relaxed", *study.after.blue_noise);
    }
}

std::string csv_text(const Subject& subject, const Study& study) {
    std::string csv = "map,neighbours,seconds,rel,RMSE,SSIM,energy";
    for (const Edge& edge : subject.edges)
        csv += "," + edge.name + " width";
    csv += "\n";
    const auto number = [](double value) { return std::isfinite(value) ? text(",%.6g", value) : std::string(","); };
    for (const Row& row : rows_of(study)) {
        const Errors unknown{NAN, NAN, NAN, NAN}, &errors = row.look->errors ? *row.look->errors : unknown;
        csv += row.map + text(",%zu", row.look->neighbours) + number(row.look->seconds) + number(errors.relative) +
               number(errors.rmse) + number(errors.ssim) + number(errors.energy);
        for (const double width : row.look->edge_widths)
            csv += number(width);
        csv += "\n";
    }
    return csv;
}

} // namespace nephroid::examples::relaxation
