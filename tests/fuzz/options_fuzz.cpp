// SPDX-License-Identifier: MIT
/// @file  Feeds the options of `caustics` with lines that libFuzzer makes up: arguments are separated by line ends.
#include "common/caustics/options.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace nephroid::examples;
    std::vector<std::string> arguments{"caustics"};
    arguments.emplace_back();
    for (std::size_t i = 0; i < size; ++i) {
        if (data[i] == '\n')
            arguments.emplace_back();
        else if (data[i] != 0)
            arguments.back() += static_cast<char>(data[i]);
    }
    std::vector<const char*> argv;
    for (const std::string& argument : arguments)
        argv.push_back(argument.c_str());
    try {
        const auto options = read_options(static_cast<int>(argv.size()), argv.data());
        if (options && (options->photons == 0 || !(options->smoothing.value_or(1) > 0) ||
                        !std::isfinite(options->smoothing.value_or(1)) || options->width == 0 || options->height == 0))
            std::abort();
    } catch (const UsageError&) {
        // refused, with a message
    }
    return 0;
}
