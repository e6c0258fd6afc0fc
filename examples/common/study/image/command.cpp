// SPDX-License-Identifier: MIT
#include "common/study/image/command.hpp"

#include "common/command_line.hpp"
#include "common/study/options.hpp"

#include <CLI/CLI.hpp>

#include <cmath>
#include <iostream>

namespace nephroid::examples::study::image {

Command::Command(CLI::App& app) {
    app.add_option("what", what_, "errors: on exact cases; flicker: of moving water [errors]")
        ->check(CLI::IsMember({"errors", "flicker"}));
    app.add_option("--nodes", nodes_, "Photons of the grid, one count or several [19881]");
    app.add_option("--size", size_, "Pixels a side [512, flicker: 256]")->check(CLI::Range(16, 4096));
    app.add_option("--frames", frames_, "Of the moving water [30]")->check(CLI::Range(4, 10000));
    app.add_option("--truth", truth_, "Nodes a side of each frame's truth [1024]")->check(CLI::Range(64, 8192));
    app.add_option("--step", step_, "Time from one frame to the next [0.03]")->check(CLI::PositiveNumber);
    app.add_option("--strip", strip_, "A .png of frames side by side: truth, sheets, ellipses, the papers' two");
    app.add_option("--format", format_, "text or markdown")->check(CLI::IsMember({"text", "markdown"}));
}

void Command::run() const {
    const auto counts = read_photon_counts(nodes_);
    const TableFormat format = format_ == "markdown" ? TableFormat::markdown : TableFormat::text;
    if (what_ == "errors") {
        if (!strip_.empty())
            throw UsageError("--strip: only flicker has frames");
        print(std::cout, error_table({{counts.begin(), counts.end()}, size_ ? size_ : 512}), format);
        return;
    }
    const auto side = std::size_t(std::llround(std::sqrt(double(counts.front()))));
    print(std::cout,
          flicker_table({.frames = frames_,
                         .size = size_ ? size_ : 256,
                         .nodes = side,
                         .truth = truth_,
                         .step = step_,
                         .strip = strip_}),
          format);
}

} // namespace nephroid::examples::study::image
