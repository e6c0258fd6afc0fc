// SPDX-License-Identifier: MIT
#include "common/study/spectrum/command.hpp"

#include "common/command_line.hpp"
#include "common/stopwatch.hpp"
#include "common/study/report.hpp"
#include "common/study/spectrum/methods.hpp"
#include "common/text.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <limits>

namespace nephroid::examples::study::spectrum {

namespace {

/// A method's error with so many walks, at its best smoothing.
struct Result {
    double bands = std::numeric_limits<double>::infinity(), colours = bands;
    double seconds = 0; ///< of the picture that is best in bands
};

[[nodiscard]] Result measure(const Method& method, std::uint64_t walks, const Subject& subject, const Picture& exact,
                             ThreadExecutor& executor) {
    Result best;
    const auto consider = [&](std::optional<double> smoothing) {
        Stopwatch stopwatch;
        const Picture picture = method.picture(subject, walks, smoothing, executor);
        const double seconds = stopwatch.lap(), error = error_in_bands(picture, exact);
        if (error < best.bands)
            best.bands = error, best.seconds = seconds;
        best.colours = (std::min)(best.colours, error_in_three_colours(picture, exact));
    };
    if (method.chooses)
        consider(std::nullopt);
    else
        for (const double smoothing : {1.5, 2., 3., 4., 6., 8., 12.})
            consider(smoothing);
    return best;
}

using Results = std::vector<std::vector<Result>>; ///< by method and number of walks

/// How many walks bring a method to an error, between those measured; nothing if none do.
[[nodiscard]] std::optional<double> walks_for(const std::vector<Result>& results,
                                              const std::vector<std::uint64_t>& walks, double error,
                                              double Result::*measure) {
    for (std::size_t i = 0; i + 1 < results.size(); ++i) {
        const double a = results[i].*measure, b = results[i + 1].*measure;
        if (a >= error && b < error)
            return double(walks[i]) *
                   std::pow(double(walks[i + 1]) / double(walks[i]), std::log(a / error) / std::log(a / b));
    }
    return std::nullopt;
}

[[nodiscard]] Table table_of(const Results& results, const std::vector<std::uint64_t>& walks, const char* name,
                             const char* title, const char* caption, double Result::*measure, const char* format) {
    Table table{name, title, caption, {"walks"}, {}};
    for (const Method& method : methods())
        table.header.push_back(method.name);
    for (std::size_t i = 0; i < walks.size(); ++i) {
        table.rows.push_back({std::to_string(walks[i])});
        for (const auto& of_method : results)
            table.rows.back().push_back(text(format, of_method[i].*measure));
    }
    return table;
}

[[nodiscard]] Table ratio_table(const Results& results, const std::vector<std::uint64_t>& walks) {
    Table table{"walks",
                "Walks for equal error",
                "How many times as many walks the others take to the error that the tangent has with so many: in 16 "
                "bands / in three colours; – where no number measured is enough",
                {"walks of the tangent"},
                {}};
    for (std::size_t m = 2; m < methods().size(); ++m)
        table.header.push_back(methods()[m].name);
    for (std::size_t i = 0; i < walks.size(); ++i) {
        table.rows.push_back({std::to_string(walks[i])});
        for (std::size_t m = 2; m < methods().size(); ++m) {
            const auto times = [&](double Result::*measure) -> std::string {
                const auto needed = walks_for(results[m], walks, results[0][i].*measure, measure);
                return needed ? text("%.1f", *needed / double(walks[i])) : "–";
            };
            table.rows.back().push_back(times(&Result::bands) + " / " + times(&Result::colours));
        }
    }
    return table;
}

} // namespace

Command::Command(CLI::App& app) : presentation_(app, {"bands", "colours", "walks", "seconds"}) {
    app.add_option("--walks", walks_, "Numbers of walks, growing [2500 to 320000]");
    app.add_option("--size", size_, "Pixels along a side [256]");
    app.add_option("--threads", threads_, "[1]");
}

void Command::run(const std::string& command) const {
    const std::vector<std::uint64_t> walks = read_photon_counts(walks_, "--walks");
    if (size_ < 16 || size_ > 2048)
        throw UsageError("--size: " + std::to_string(size_) + " is not from 16 to 2048");
    check_threads(threads_);
    Report report(presentation_.read("study-spectrum", command), "Colours: the tangent by wavelength and its rivals");
    ThreadExecutor executor(threads_);
    const Subject subject(size_);
    const Picture exact = truth(subject, executor);
    Results results;
    for (const Method& method : methods()) {
        results.emplace_back();
        for (const std::uint64_t count : walks) {
            results.back().push_back(measure(method, count, subject, exact, executor));
            std::cerr << method.name << ", " << count << " walks: " << results.back().back().bands << std::endl;
        }
    }
    report.page().paragraph(
        "Two crossed waves on a liquid that disperses like SF11 glass, sun 50° from the zenith, 16 bands from 400 to "
        "700 nm. The truth is drawn with light sheets at 48 wavelengths. Each method splats to first order at the s "
        "that is best for it, found against the truth, but for second order, which chooses.");
    report.show(table_of(results, walks, "bands", "Error in 16 bands",
                         "rms(E − E_ref)/mean(E_ref), all pixels and bands", &Result::bands, "%.3f"));
    report.show(table_of(results, walks, "colours", "Error in three colours",
                         "The same of the means of bands 1 to 5, 6 to 10 and 11 to 16", &Result::colours, "%.3f"));
    report.show(ratio_table(results, walks));
    report.show(table_of(results, walks, "seconds", "Seconds", "For the picture that is best in bands",
                         &Result::seconds, "%.3f"));
    report.finish();
}

} // namespace nephroid::examples::study::spectrum
