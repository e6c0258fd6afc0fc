// SPDX-License-Identifier: MIT
#include "common/study/smoothing/command.hpp"

#include "common/builtin_film.hpp"
#include "common/study/records.hpp"
#include "common/study/report.hpp"
#include "common/study/smoothing/tables.hpp"

#include "nephroid/pass/photon_pass.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>

namespace nephroid::examples::study::smoothing {

namespace {

const std::string exact_cases = "wave-focused,wave-prefocal,ring,ring-zoom,ball,ball-point";

[[nodiscard]] std::vector<std::string> read_cases(const std::string& text) {
    const std::vector<std::string> cases = listed("--cases", text);
    for (const std::string& name : cases)
        if (!is_builtin(name))
            throw UsageError("--cases: '" + name + "' is none of " + builtin_names());
    return cases;
}

void check(const Options& options) {
    if (!(options.fixed_smoothing > 0) || !std::isfinite(options.fixed_smoothing))
        throw UsageError("--fixed-smoothing: it must be positive and finite");
    if (options.each.fresnel &&
        std::ranges::any_of(options.cases, [](const std::string& name) { return name.starts_with("ring"); }))
        throw UsageError("--fresnel: the ring is a perfect mirror; leave it out of --cases");
    if (options.cases.size() > 1 && (options.each.reference || options.each.view))
        throw UsageError("--reference, --view: are of one case, and --cases names several");
}

[[nodiscard]] std::string csv_of(const std::vector<Case>& cases) {
    std::string csv = csv_header();
    for (const Case& one : cases)
        for (const auto* trials : {&one.best, &one.fixed, &one.second})
            csv += csv_rows(one.name, *trials);
    return csv;
}

} // namespace

Command::Command(CLI::App& app)
    : cases_(exact_cases), fixed_smoothing_(default_smoothing),
      measuring_(app, {"5000,20000,80000,320000,1280000", "256", 1, 1}), presentation_(app, table_names()) {
    app.add_option("--cases", cases_,
                   "Some of " + exact_cases + " [all], or with a --reference one of " + builtin_names());
    app.add_option("--fixed-smoothing", fixed_smoothing_, "s of the slopes at a fixed s [8]");
}

Options Command::options() const {
    const Options options{read_cases(cases_), measuring_.read(), fixed_smoothing_};
    check(options);
    return options;
}

void Command::run(const std::string& command) const {
    const Options options = this->options();
    const Presentation presentation = presentation_.read("study-smoothing", command);
    check_references(options);
    Report report(presentation, "Smoothing: chosen photon by photon, against the best for all");
    const auto cases = measure_cases(options, [](const Trial& trial) { std::cerr << summary(trial) << std::endl; });
    report.write("results.csv", csv_of(cases));
    report.page().paragraph(
        "Second-order splatting with nothing to choose, and first order at the s that is best by each measure, found "
        "against the truth: the same photons, the same eye path vertices. rel is rms(E − E<sub>ref</sub>)/"
        "mean(E<sub>ref</sub>), RMSE that of the pictures exposed to half grey and clipped.");
    report.show(equal_photons_table(cases));
    report.show(equal_seconds_table(cases));
    report.show(slopes_table(cases, options.fixed_smoothing));
    report.page().heading("Error against photons");
    report.page().plots(report.draw(drawings(cases)));
    report.page().heading("All figures");
    const Table errors = errors_table(cases);
    report.print(errors, false);
    report.page().table(errors);
    report.finish();
}

} // namespace nephroid::examples::study::smoothing
