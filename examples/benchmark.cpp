// SPDX-License-Identifier: MIT
/// @file  How fast nephroid is, as ratios to yardsticks that are measured in the same run: `benchmark`, or
///        `benchmark splat knn` for a choice of rows.
#include "common/benchmark/long_run.hpp"
#include "common/benchmark/matrices.hpp"
#include "common/benchmark/passes.hpp"
#include "common/benchmark/rays.hpp"
#include "common/benchmark/splatting.hpp"
#include "common/benchmark/trees.hpp"
#include "common/command_line.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <exception>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

namespace {

namespace bench = nephroid::examples::benchmarks;

using Rows = void (*)(const bench::Effort&);

/// In the order in which they run.
constexpr std::array<std::pair<const char*, Rows>, 13> rows = {{{"splat", bench::benchmark_splatting},
                                                                {"build", bench::benchmark_build},
                                                                {"order", bench::benchmark_order},
                                                                {"tangents", bench::benchmark_tangents},
                                                                {"matrix", bench::benchmark_matrices},
                                                                {"knn", bench::benchmark_nearest},
                                                                {"relax", bench::benchmark_relaxation},
                                                                {"rays", bench::benchmark_rays},
                                                                {"pass", bench::benchmark_pass},
                                                                {"frame", bench::benchmark_frame},
                                                                {"threads", bench::benchmark_threads},
                                                                {"growth", bench::benchmark_growth},
                                                                {"long", bench::benchmark_long_run}}};

} // namespace

int main(int argc, char** argv) {
    using namespace nephroid::examples;
    try {
        CLI::App app(
            "Times the library against nanoflann, Embree, GLM and itself; every figure is the least of several");
        std::vector<std::string> chosen_rows;
        bench::Effort effort;
        std::string names, photons = "1e6";
        for (const auto& [name, run] : rows)
            names += std::string(name) + " ";
        app.add_option("rows", chosen_rows, "Which of: " + names + "[all]");
        app.add_option("--seconds", effort.seconds, "Of each repetition, at least [0.04]");
        app.add_option("--repetitions", effort.repetitions, "Of which the least time counts [5]");
        app.add_flag("--instructions", effort.instructions,
                     "Counts them, under valgrind --tool=callgrind; each is printed as a nanosecond");
        app.add_flag("--full", effort.full, "The large sizes as well: 1.3 million triangles, 4096 x 4096");
        app.add_option("--photons", photons, "Of the row long [1e6]");
        if (!parse(app, argc, argv))
            return 0;
        effort.photons = whole_number("--photons", photons, 1);
        if (!(effort.seconds > 0 && effort.seconds <= 60) || effort.repetitions < 1 || effort.repetitions > 1000)
            throw UsageError("--seconds, --repetitions: above 0 to 60 seconds, 1 to 1000 repetitions");

        if (effort.instructions && !bench::counts_instructions())
            throw UsageError("--instructions: only under valgrind --tool=callgrind, and if built with its header "
                             "(Debian: valgrind)");
        std::vector<Rows> to_run;
        for (const std::string& name : chosen_rows) {
            const auto* const found =
                std::find_if(rows.begin(), rows.end(), [&](const auto& row) { return name == row.first; });
            if (found == rows.end())
                throw UsageError("rows: '" + name + "' is none of " + names);
            to_run.push_back(found->second);
        }
        if (chosen_rows.empty())
            for (const auto& row : rows)
                to_run.push_back(row.second);
        bench::print_heading();
        for (const Rows run : to_run)
            run(effort);
        return 0;
    } catch (const UsageError& error) {
        std::cerr << "benchmark: " << error.what() << '\n';
        return 2;
    } catch (const std::exception& error) {
        std::cerr << "benchmark: " << error.what() << '\n';
        return 1;
    }
}
