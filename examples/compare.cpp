// SPDX-License-Identifier: MIT
/// @file  Measures photon differential splatting and its rivals: error against bandwidth, photons and time, as tables,
/// plots, pictures and one page with all of them.
#include "common/compare/page.hpp"
#include "common/compare/records.hpp"
#include "common/image/file.hpp"
#include "common/image/png.hpp"

#include <exception>
#include <iostream>

namespace {

using namespace nephroid::examples;

/// Pictures of trials that are shown side by side are kept, the others only written.
[[nodiscard]] std::vector<Trial> run_and_write_pictures(const CompareOptions& options, const Bench& bench,
                                                        const std::filesystem::path& pictures) {
    const Samples reference(options.width, options.height, 1, {bench.reference().begin(), bench.reference().end()});
    write_png(pictures / "reference.png", reference, bench.exposure());
    return compare(options, bench, [&](Trial& trial) {
        std::cout << summary(trial) << std::endl;
        write_pictures(pictures, bench, trial);
        if (trial.wanted != target_photons(options))
            for (Best& best : trial.best)
                best.irradiance = {};
    });
}

void print_tables(const CompareOptions& options, const std::vector<Trial>& trials) {
    for (const Table& table : equal_error_tables(options, trials))
        print(std::cout, table);
    for (const Table& table : equal_time_tables(options, trials))
        print(std::cout, table);
    if (options.photons.size() > 1)
        print(std::cout, slope_table(options, trials));
}

void run(const CompareOptions& options) {
    const std::filesystem::path pictures = options.output / "pictures";
    std::filesystem::create_directories(pictures);
    if (options.html)
        require_writable(*options.html);
    Stopwatch stopwatch;
    const Bench bench(options);
    const std::vector<Trial> trials = run_and_write_pictures(options, bench, pictures);
    Exhibition exhibition{{}, write_strips(pictures, options, bench, trials), pictures, stopwatch.lap()};

    write_file(options.output / "results.csv", csv_text(options, trials));
    write_file(options.output / "results.json", json_text(options, bench, trials));
    print_tables(options, trials);
    if (has_gnuplot())
        exhibition.plots = draw_plots(options.output / "plots", options, trials);
    else
        std::cout << "note: the plots are left out, gnuplot is missing (Debian: gnuplot-nox)\n";
    if (options.html)
        write_file(*options.html, html_page(options, bench, trials, exhibition));
    std::cout << "\nresults: " << options.output.string() << '\n';
    if (options.html)
        std::cout << "report: " << options.html->string() << '\n';
}

} // namespace

int main(int argc, char** argv) {
    try {
        if (const auto options = read_compare_options(argc, argv))
            run(*options);
        return 0;
    } catch (const UsageError& error) {
        std::cerr << "compare: " << error.what() << '\n';
        return 2;
    } catch (const std::exception& error) {
        std::cerr << "compare: " << error.what() << '\n';
        return 1;
    }
}
