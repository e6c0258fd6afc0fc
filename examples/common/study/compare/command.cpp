// SPDX-License-Identifier: MIT
#include "common/study/compare/command.hpp"

#include "common/builtin_film.hpp"
#include "common/image/png.hpp"
#include "common/study/bench.hpp"
#include "common/study/compare/page.hpp"
#include "common/study/compare/pictures.hpp"
#include "common/study/compare/plots.hpp"
#include "common/study/compare/tables.hpp"
#include "common/study/records.hpp"
#include "common/study/report.hpp"

#include <CLI/CLI.hpp>

#include <iostream>

namespace nephroid::examples::study::compare {

namespace {

[[nodiscard]] std::vector<std::string> read_methods(const std::string& text) {
    std::vector<std::string> ids;
    if (text.empty()) {
        for (const Method& method : methods())
            if (method.id != "nearest-checked") // slow, as the best k is large and each look-up is sorted
                ids.push_back(method.id);
        return ids;
    }
    for (const std::string& word : listed("--methods", text)) {
        if (word == "all")
            for (const Method& method : methods())
                ids.push_back(method.id);
        else if (find_method(word))
            ids.push_back(word);
        else
            throw UsageError("--methods: '" + word + "' is none of all, " + method_names());
    }
    return ids;
}

/// Pictures of trials that are shown side by side are kept, the others only written.
[[nodiscard]] std::vector<Trial> run_and_write_pictures(const Options& options, const Bench& bench,
                                                        const std::filesystem::path& pictures) {
    const Samples reference(options.width, options.height, 1, {bench.reference().begin(), bench.reference().end()});
    write_png(pictures / "reference.png", reference, bench.exposure());
    return all_trials(options, bench, [&](Trial& trial) {
        std::cerr << summary(trial) << std::endl;
        write_pictures(pictures, bench, trial);
        if (trial.wanted != target_photons(options))
            for (Best& best : trial.best)
                best.irradiance = {};
    });
}

/// The plots of one kind, such as "time".
[[nodiscard]] std::vector<Plot> of_kind(const std::vector<Plot>& plots, const std::string& kind) {
    std::vector<Plot> own;
    for (const Plot& plot : plots)
        if (plot.svg.filename().string().starts_with(kind))
            own.push_back(plot);
    return own;
}

void fill(Report& report, const Options& options, const Bench& bench, const std::vector<Trial>& trials,
          const std::filesystem::path& pictures) {
    Page& page = report.page();
    const std::vector<Plot> plots = report.draw(drawings(options, trials));
    begin_page(page, options, bench, trials, pictures);
    page.heading("Error against time");
    page.plots(of_kind(plots, "time-"));
    page.heading("Equal error");
    report.show(equal_error_tables(options, trials));
    page.heading("Equal time");
    report.show(equal_time_tables(options, trials));
    page.heading("Side by side");
    page.note(
        "Below each picture where it is wrong, four times brighter: red where there is too much light, blue where "
        "too little.");
    for (const Strip& strip : write_strips(pictures, options, bench, trials))
        page.strip(strip);
    if (options.photons.size() > 1) {
        page.heading("Error against photons");
        page.plots(of_kind(plots, "photons-"));
        report.show(slope_table(options, trials));
    }
    page.heading("Error against bandwidth");
    page.plots(of_kind(plots, "bandwidth-"));
    page.heading("All figures");
    for (const Measure measure : measures) {
        const Table best = best_table(trials, measure);
        report.print(best, false);
        page.folded_table(std::string("Best by ") + name_of(measure), best);
    }
    end_page(page, options);
}

} // namespace

Command::Command(CLI::App& app)
    : measuring_(app, {"20000,200000,1000000", "512", 0, 3}), presentation_(app, table_names()) {
    app.add_option("case", scene_, "A built-in case: " + builtin_names())->required();
    app.add_option("--methods", methods_,
                   "all, or some of " + method_names() + " [all but nearest-checked, which is slow]");
    app.add_flag("--sweep", sweep_, "Also bandwidths far from the best, for the curves of the smallest count");
}

Options Command::options() const {
    Options options = measuring_.read();
    if (!is_builtin(scene_))
        throw UsageError("'" + scene_ + "' is none of " + builtin_names());
    options.scene = scene_;
    options.methods = read_methods(methods_);
    options.sweep = sweep_;
    return options;
}

Presentation Command::presentation(const std::string& command) const {
    return presentation_.read("study-compare-" + scene_, command);
}

void Command::run(const std::string& command) const {
    const Options options = this->options();
    const Presentation presentation = this->presentation(command);
    const Bench bench(options);
    Report report(presentation, "Speed against error: " + options.scene);
    const std::filesystem::path pictures = report.folder("pictures");
    const std::vector<Trial> trials = run_and_write_pictures(options, bench, pictures);
    report.write("results.csv", csv_header() + csv_rows(options.scene, trials));
    report.write("results.json", json_text(options, bench, trials, command));
    fill(report, options, bench, trials, pictures);
    report.finish();
}

} // namespace nephroid::examples::study::compare
