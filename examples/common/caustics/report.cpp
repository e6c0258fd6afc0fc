// SPDX-License-Identifier: MIT
#include "common/caustics/report.hpp"

#include "common/text.hpp"

#include "nephroid/pass/diagnose.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <utility>
#include <vector>

#if !defined(_WIN32)
#include <sys/resource.h>
#endif

namespace nephroid::examples {

namespace {

/// The process's peak memory in bytes; 0 if the system does not tell.
[[nodiscard]] double peak_memory() {
#if defined(_WIN32)
    return 0;
#else
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
#if defined(__APPLE__)
    return double(usage.ru_maxrss);
#else
    return 1024.0 * double(usage.ru_maxrss);
#endif
#endif
}

void line(std::ostream& out, const std::string& name, const std::string& value, const std::string& note = "") {
    out << text("  %-20s %16s  %s\n", name.c_str(), value.c_str(), note.c_str());
}

/// Of a layer that took several.
void passes_lines(std::ostream& out, const std::string& whose, const PassReport& passes) {
    if (passes.passes > 1)
        line(out, whose + "passes", grouped(passes.passes),
             std::isfinite(*passes.noise) ? text("noise of their mean %.2f%%", 100 * *passes.noise)
                                          : "all dark: give --photons, or --emit, more for each");
}

[[nodiscard]] std::string passes_json(const PassReport& passes) {
    return json_object({{"passes", std::to_string(passes.passes)},
                        {"noise", passes.noise && std::isfinite(*passes.noise) ? json_number(*passes.noise) : "null"}},
                       "  ");
}

[[nodiscard]] std::vector<std::pair<std::string, double>> phases(const Timings& seconds) {
    return {{"eye paths", seconds.eye_paths}, {"eye path map", seconds.map},        {"pilot", seconds.pilot},
            {"trace", seconds.trace},         {"footprints", seconds.fit},          {"splat", seconds.splat},
            {"direct light", seconds.direct}, {"indirect light", seconds.indirect}, {"other", seconds.other()},
            {"total", seconds.total}};
}

[[nodiscard]] std::string indirect_json(const GlobalSplats& indirect) {
    const Statistics& statistics = indirect.statistics;
    return json_object({{"photons emitted", std::to_string(statistics.emitted.photons)},
                        {"arrivals", std::to_string(statistics[Arrival::indirect].photons)},
                        {"radius", json_number(indirect.radius)},
                        {"flux emitted", json_number(statistics.emitted.flux)},
                        {"flux accounted", json_number(statistics.accounted_flux())}},
                       "  ");
}

/// What looks wrong in the passes of the layers that were asked for.
[[nodiscard]] std::vector<std::string> diagnoses(const Report& report) {
    std::vector<std::string> sentences;
    if (report.has_caustics)
        sentences = diagnose(report.statistics);
    if (!report.indirect)
        return sentences;
    Statistics indirect = report.indirect->statistics;
    if (report.bounces < all_bounces) // light that ends there does so as was asked
        indirect.fates[static_cast<std::size_t>(Fate::terminated)] = {};
    if (indirect.emitted.photons > 0 && indirect.diffuse_events == 0)
        sentences.push_back("indirect light: no photon met a diffuse surface: does the lamp shine on one?");
    else
        for (const std::string& sentence : diagnose(indirect))
            sentences.push_back("indirect light: " + sentence);
    return sentences;
}

[[nodiscard]] std::string splats_text(const Options& options) {
    const std::string order = options.first_order ? "first order, " : options.curved ? "curved, " : "";
    return order + name_of(options.sequence) + ", " + name_of(options.kernel) +
           (options.pixel_filter ? "" : ", no pixel filter") +
           (options.bands ? ", " + std::to_string(*options.bands) + " bands" : "");
}

/// The light that is not counted in the fates, of one pass.
[[nodiscard]] double unresolved_flux(const Report& report) {
    const auto passes = double((std::max)(report.caustic_passes.passes, std::uint64_t(1)));
    return report.sheets ? report.sheets->unresolved / passes : 0;
}

/// Flux as a share of what was emitted in all passes.
[[nodiscard]] std::string share_text(double flux, const Report& report) {
    const auto passes = double((std::max)(report.caustic_passes.passes, std::uint64_t(1)));
    return text("%.3f%%", 100 * flux / (passes * report.statistics.emitted.flux));
}

void sheet_lines(std::ostream& out, const Report& report) {
    const SheetAccount& account = report.sheets->account;
    line(out, "cells drawn", grouped(account.cells));
    line(out, "cells with an end", grouped(account.cut_cells), share_text(account.cut.flux, report) + " of the light");
    line(out, "parts splatted", grouped(account.broken_tiles),
         share_text(account.handed_over.flux, report) + " of the light, on no sheet");
}

[[nodiscard]] std::string sheets_json(const SheetReport& sheets) {
    const SheetAccount& account = sheets.account;
    return json_object({{"nodes", std::to_string(account.nodes)},
                        {"cells", std::to_string(account.cells)},
                        {"cut cells", std::to_string(account.cut_cells)},
                        {"flux in cut cells", json_number(account.cut.flux)},
                        {"broken parts", std::to_string(account.broken_tiles)},
                        {"flux splatted", json_number(account.handed_over.flux)},
                        {"flux unresolved", json_number(sheets.unresolved)},
                        {"photons splatted", std::to_string(sheets.splats.emitted.photons)}},
                       "  ");
}

} // namespace

void Report::note(const std::string& text) {
    notes.push_back(text);
    std::cout << "note: " << text << std::endl;
}

void print_table(std::ostream& out, const Options& options, const Report& report) {
    const Statistics& statistics = report.statistics;
    out << "caustics " << options.scene << (report.smoothing ? text(", s = %g, ", *report.smoothing) : ", ")
        << (report.sheets ? "light sheets" : splats_text(options))
        << text(", %zu x %zu, %u thread%s\n", options.width, options.height, report.threads,
                report.threads == 1 ? "" : "s");
    for (const std::string& sentence : diagnoses(report))
        out << "note: " << sentence << '\n';
    line(out, "photons emitted", grouped(statistics.emitted.photons));
    line(out, "caustic photons", grouped(statistics.caustic_photons()));
    line(out, "rays", grouped(statistics.rays));
    passes_lines(out, "", report.caustic_passes);
    line(out, "eye path vertices", grouped(report.eye_vertices));
    line(out, "peak memory", text("%.1f MB", peak_memory() * 1e-6));
    if (report.sheets)
        sheet_lines(out, report);
    if (statistics.bounded_footprints > 0)
        line(out, "footprints bounded", grouped(statistics.bounded_footprints));
    if (statistics.bounded_shifts > 0)
        line(out, "shifts bounded", grouped(statistics.bounded_shifts));
    if (statistics.splatted_as_published > 0)
        line(out, "as published", grouped(statistics.splatted_as_published));
    if (statistics.corrected_normals > 0)
        line(out, "normals corrected", grouped(statistics.corrected_normals));

    if (report.indirect) {
        line(out, "indirect photons", grouped(report.indirect->statistics.emitted.photons));
        line(out, "their arrivals", grouped(report.indirect->statistics[Arrival::indirect].photons));
        passes_lines(out, "their ", report.indirect_passes);
        line(out, "their disks' radius", text("%.4g", report.indirect->radius));
    }

    out << "seconds\n";
    for (const auto& [name, seconds] : phases(report.seconds))
        if (seconds > 0)
            line(out, name, text("%.3f", seconds),
                 name == "trace" ? text("%.2f M photons/s", double(statistics.emitted.photons) / seconds * 1e-6) : "");

    out << "flux\n";
    const double emitted = statistics.emitted.flux;
    line(out, "emitted", text("%.6g", emitted));
    for (std::size_t i = 0; i < fate_count; ++i) {
        const Tally& tally = statistics.fates[i];
        if (tally.photons > 0 || tally.flux != 0)
            line(out, fate_names[i], text("%.6g", tally.flux), text("%.3f%%", 100 * tally.flux / emitted));
    }
    if (report.sheets)
        line(out, "between sheets", text("%.6g", unresolved_flux(report)),
             text("%.3f%%", 100 * unresolved_flux(report) / emitted));
    line(out, "unaccounted", text("%.2g", emitted - statistics.accounted_flux() - unresolved_flux(report)));

    if (report.errors) {
        out << "against " << (options.reference ? options.reference->string() : "the exact picture") << '\n';
        line(out, "rel", text("%.4f", report.errors->relative));
        line(out, "clipped RMSE", text("%.4f", report.errors->rmse));
        line(out, "SSIM", std::isfinite(report.errors->ssim) ? text("%.4f", report.errors->ssim) : "-");
        line(out, "energy error", text("%+.4f%%", 100 * report.errors->energy));
    }
}

std::string json_text(const Options& options, const Report& report) {
    const Statistics& statistics = report.statistics;
    JsonMembers fates, seconds, top;
    for (std::size_t i = 0; i < fate_count; ++i)
        fates.push_back({fate_names[i], json_object({{"photons", std::to_string(statistics.fates[i].photons)},
                                                     {"flux", json_number(statistics.fates[i].flux)}},
                                                    "    ")});
    for (const auto& [name, value] : phases(report.seconds))
        seconds.push_back({name, json_number(value)});
    top = {{"scene", json_string(options.scene)},
           {"layer", json_string(name_in(layer_names(), options.layer))},
           {"bounces", report.bounces < all_bounces ? std::to_string(report.bounces) : json_string("all")},
           {"smoothing", report.smoothing ? json_number(*report.smoothing) : json_string("auto")},
           {"bands", options.bands ? std::to_string(*options.bands) : "null"},
           {"method", json_string(name_of(options.method))},
           {"order", options.first_order ? "1" : "2"},
           {"sequence", json_string(name_of(options.sequence))},
           {"kernel", json_string(name_of(options.kernel))},
           {"pixel filter", options.pixel_filter ? "true" : "false"},
           {"seed", std::to_string(options.seed)},
           {"width", std::to_string(options.width)},
           {"height", std::to_string(options.height)},
           {"threads", std::to_string(report.threads)},
           {"eye path vertices", std::to_string(report.eye_vertices)},
           {"peak memory", json_number(peak_memory())},
           {"photons emitted", std::to_string(statistics.emitted.photons)},
           {"caustic photons", std::to_string(statistics.caustic_photons())},
           {"rays", std::to_string(statistics.rays)},
           {"specular events", std::to_string(statistics.specular_events)},
           {"corrected normals", std::to_string(statistics.corrected_normals)},
           {"bounded footprints", std::to_string(statistics.bounded_footprints)},
           {"bounded shifts", std::to_string(statistics.bounded_shifts)},
           {"splatted as published", std::to_string(statistics.splatted_as_published)},
           {"flux emitted", json_number(statistics.emitted.flux)},
           {"flux accounted", json_number(statistics.accounted_flux())},
           {"fates", json_object(fates, "  ")},
           {"seconds", json_object(seconds, "  ")},
           {"interrupted", report.interrupted ? "true" : "false"},
           {"notes", json_array(report.notes)}};
    if (options.error && report.has_caustics)
        top.push_back({"caustic passes", passes_json(report.caustic_passes)});
    if (options.error && report.indirect)
        top.push_back({"indirect passes", passes_json(report.indirect_passes)});
    if (report.sheets)
        top.push_back({"sheets", sheets_json(*report.sheets)});
    if (report.indirect)
        top.push_back({"indirect", indirect_json(*report.indirect)});
    if (report.errors)
        top.push_back({"errors", json_object({{"rel", json_number(report.errors->relative)},
                                              {"clipped RMSE", json_number(report.errors->rmse)},
                                              {"SSIM", json_number(report.errors->ssim)},
                                              {"energy", json_number(report.errors->energy)}},
                                             "  ")});
    return json_object(top, "") + "\n";
}

} // namespace nephroid::examples
