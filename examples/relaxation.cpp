// SPDX-License-Identifier: MIT
/// @file  Relaxes the photons of a test pattern, a guide image, a built-in caustic or a glTF scene into blue noise, and
///        shows before and after: pictures, errors, edges, spectra.
#include "common/image/file.hpp"
#include "common/relaxation/pictures.hpp"
#include "common/relaxation/table.hpp"
#include "common/relaxation/timing.hpp"

#include <exception>
#include <iostream>

int main(int argc, char** argv) {
    using namespace nephroid::examples;
    try {
        const auto options = relaxation::read_options(argc, argv);
        if (!options)
            return 0;
        nephroid::ThreadExecutor threads(options->threads);
        if (options->timing) {
            relaxation::print_timing(std::cout, *options, threads);
            return 0;
        }
        const relaxation::Subject subject = relaxation::make_subject(*options, threads);
        std::filesystem::create_directories(options->output);
        require_writable(options->output / "table.csv");

        const relaxation::Study study = relaxation::study(subject, *options, threads);
        print_table(std::cout, *options, subject, study);
        write_file(options->output / "table.csv", csv_text(subject, study));
        for (const std::string& note : write_pictures(options->output, subject, study))
            std::cout << "note: " << note << '\n';
        for (const std::string& note : write_plots(options->output, subject, study))
            std::cout << "note: " << note << '\n';
        std::cout << "pictures, plots and table: " << options->output.string() << '\n';
        return 0;
    } catch (const UsageError& error) {
        std::cerr << "relaxation: " << error.what() << '\n';
        return 2;
    } catch (const std::exception& error) {
        std::cerr << "relaxation: " << error.what() << '\n';
        return 1;
    }
}
