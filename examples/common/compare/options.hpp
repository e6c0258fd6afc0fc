// SPDX-License-Identifier: MIT
/// @file  What the program `compare` is asked to do.
#pragma once

#include "common/any_sequence.hpp"

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace nephroid::examples {

struct CompareOptions {
    std::string scene;                                                 ///< the name of a built-in case
    std::vector<std::string> methods;                                  ///< ids, in the order of the tables; never empty
    std::vector<std::uint64_t> photons = {20'000, 200'000, 1'000'000}; ///< caustic photons wanted, growing
    std::vector<SequenceKind> sequences = {SequenceKind::halton, SequenceKind::random};
    std::uint64_t seed = 0;
    std::size_t width = 512, height = 512; ///< pixels
    unsigned samples = 1;                  ///< eye paths per pixel
    unsigned threads = 0;                  ///< 0: as many as the machine has
    bool sweep = false;                    ///< also far from the best bandwidth, for the smallest count
    unsigned repeats = 3;                  ///< of each timing, at most
    bool fresnel = false;
    std::optional<std::array<double, 4>> view;           ///< x_min, x_max, y_min, y_max
    std::optional<std::filesystem::path> reference;      ///< .pfm, instead of the exact picture
    std::optional<std::filesystem::path> standard_error; ///< .pfm, of the reference's pixels
    std::filesystem::path output;                        ///< a folder for figures, plots, pictures
    std::optional<std::filesystem::path> html;           ///< the report
    std::string command;                                 ///< as it was called
};

/// The words between commas. Throws UsageError for an empty one, which names the option.
[[nodiscard]] std::vector<std::string> listed(const std::string& option, const std::string& text);

/// "5000,2e4": counts of --photons, growing, each once, from 100 to 1e8. Throws UsageError.
[[nodiscard]] std::vector<std::uint64_t> read_photon_counts(const std::string& text);

/// "halton,random": kinds of --sequence, each once. Throws UsageError.
[[nodiscard]] std::vector<SequenceKind> read_sequences(const std::string& text);

/// Reads the command line.
/// @return  nothing if it asked for help, which has then been printed
/// Throws UsageError.
[[nodiscard]] std::optional<CompareOptions> read_compare_options(int argc, const char* const* argv);

} // namespace nephroid::examples
