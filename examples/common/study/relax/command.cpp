// SPDX-License-Identifier: MIT
#include "common/study/relax/command.hpp"

#include "common/study/relax/pictures.hpp"
#include "common/study/relax/tables.hpp"
#include "common/study/relax/timing.hpp"
#include "common/study/report.hpp"

namespace nephroid::examples::study::relax {

namespace {

[[nodiscard]] std::string name_of_subject(const Options& options) {
    return std::filesystem::path(options.subject).stem().string();
}

/// Relaxes the subject and adds what comes of it to the report.
/// @return  its row of the verdict, if the truth is known
[[nodiscard]] std::optional<TableRow> add_subject(Report& report, const Options& options, bool several_sequences,
                                                  const Subject& subject, ThreadExecutor& threads) {
    std::string name = name_of_subject(options);
    if (several_sequences)
        name += std::string("-") + name_of(options.sequence);
    const BeforeAndAfter measured = before_and_after(subject, options, threads);
    Page& page = report.page();
    page.heading(name);
    for (const std::string& note : subject.notes)
        report.say("note: " + note);
    report.show(errors_table(options, subject, measured));
    if (const Table spectrum = spectrum_table(measured); !spectrum.rows.empty())
        report.show(spectrum);
    report.write(name + ".csv", csv_text(subject, measured));
    page.pictures(write_pictures(report.folder("pictures/" + name), subject, measured));
    if (!subject.floor)
        report.say("note: photons are drawn as dots on a floor alone, so there are no such pictures of a file");
    const std::vector<Drawing> plots = drawings(subject, measured);
    if (!plots.empty())
        page.plots(report.draw(plots, "plots/" + name));
    return verdict_row(options, measured);
}

} // namespace

Command::Command(CLI::App& app) : arguments_(app), presentation_(app, table_names()) {}

void Command::run(const std::string& command) const {
    const std::vector<Options> all = options();
    const std::string first = name_of_subject(all.front());
    const Presentation presentation = presentation_.read("study-relax-" + (all.front().timing ? "cost"
                                                                           : all.size() > 1   ? "several"
                                                                                              : first),
                                                         command);
    ThreadExecutor threads(all.front().threads);
    Subject subject;
    if (!all.front().timing)
        subject = make_subject(all.front(), threads); // before the folder is made, as this may be refused
    Report report(presentation, "Photon relaxation");
    if (all.front().timing) {
        report.show(cost_table(all.front(), threads));
        report.finish();
        return;
    }
    std::vector<TableRow> verdicts;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (i > 0)
            subject = make_subject(all[i], threads);
        const bool several_sequences = all.front().sequence != all.back().sequence;
        if (auto row = add_subject(report, all[i], several_sequences, subject, threads))
            verdicts.push_back(std::move(*row));
    }
    if (!verdicts.empty())
        report.show(verdict_table(std::move(verdicts)));
    report.finish();
}

} // namespace nephroid::examples::study::relax
