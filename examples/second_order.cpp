// SPDX-License-Identifier: MIT
/// @file  Measures second-order splatting against first order at its best smoothing: at equal photons, at equal time,
///        and how both converge.
#include "common/image/file.hpp"
#include "common/second_order/tables.hpp"

#include <exception>
#include <iostream>

int main(int argc, char** argv) {
    using namespace nephroid::examples;
    try {
        const auto options = second_order::read_options(argc, argv);
        if (!options)
            return 0;
        if (options->csv)
            require_writable(*options->csv);
        const auto studies =
            second_order::study(*options, [](const Trial& trial) { std::cerr << summary(trial) << std::endl; });
        if (options->csv)
            write_file(*options->csv, second_order::csv_text(studies));
        second_order::print_markdown(std::cout, equal_photons_table(studies));
        second_order::print_markdown(std::cout, equal_seconds_table(studies));
        second_order::print_markdown(std::cout, slopes_table(studies, options->fixed_smoothing));
        return 0;
    } catch (const UsageError& error) {
        std::cerr << "second_order: " << error.what() << '\n';
        return 2;
    } catch (const std::exception& error) {
        std::cerr << "second_order: " << error.what() << '\n';
        return 1;
    }
}
