// SPDX-License-Identifier: MIT
/// @file  Measures the library's claims against exact results: `study compare`, `study smoothing`, `study relax`,
///        `study spectrum`, which leave figures, plots, pictures and a page with all of them in a folder; and `study
///        image` and `study judge`, which print.
#include "common/study/compare/command.hpp"
#include "common/study/image/command.hpp"
#include "common/study/judge/command.hpp"
#include "common/study/relax/command.hpp"
#include "common/study/smoothing/command.hpp"
#include "common/study/spectrum/command.hpp"

#include <CLI/CLI.hpp>

#include <exception>
#include <iostream>
#include <string>

namespace {

/// The command line as it was typed, but for the program's folder.
[[nodiscard]] std::string command_line(int argc, const char* const* argv) {
    std::string command = "study";
    for (int i = 1; i < argc; ++i)
        command += " " + std::string(argv[i]);
    return command;
}

void run(int argc, const char* const* argv) {
    using namespace nephroid::examples;
    CLI::App app("Measures nephroid against the truth and its rivals", "study");
    app.require_subcommand(1);
    CLI::App& compare_app =
        *app.add_subcommand("compare", "Splatting and its rivals: error against bandwidth, photons and time");
    CLI::App& smoothing_app =
        *app.add_subcommand("smoothing", "Footprints chosen photon by photon, against the best smoothing for all");
    CLI::App& relax_app = *app.add_subcommand("relax", "A photon map relaxed into blue noise: before and after");
    CLI::App& spectrum_app =
        *app.add_subcommand("spectrum", "Colours by tangents, against brute force, three indices and none");
    CLI::App& image_app = *app.add_subcommand("image", "Photons on a grid, drawn onto a raster: error and flicker");
    CLI::App& judge_app =
        *app.add_subcommand("judge", "The default against the published method, on scenes from seeds");
    const study::compare::Command compare(compare_app);
    const study::smoothing::Command smoothing(smoothing_app);
    const study::relax::Command relax(relax_app);
    const study::spectrum::Command spectrum(spectrum_app);
    const study::image::Command image(image_app);
    const study::judge::Command judge(judge_app);
    if (!parse(app, argc, argv))
        return;
    const std::string command = command_line(argc, argv);
    if (compare_app.parsed())
        compare.run(command);
    if (smoothing_app.parsed())
        smoothing.run(command);
    if (image_app.parsed())
        image.run();
    if (judge_app.parsed())
        judge.run();
    if (relax_app.parsed())
        relax.run(command);
    if (spectrum_app.parsed())
        spectrum.run(command);
}

} // namespace

int main(int argc, char** argv) {
    try {
        run(argc, argv);
        return 0;
    } catch (const nephroid::examples::UsageError& error) {
        std::cerr << "study: " << error.what() << '\n';
        return 2;
    } catch (const std::exception& error) {
        std::cerr << "study: " << error.what() << '\n';
        return 1;
    }
}
