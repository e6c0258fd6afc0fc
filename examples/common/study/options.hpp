// SPDX-License-Identifier: MIT
/// @file  What a study is asked with: a case, photons and pixels, and where the answer goes.
#pragma once

#include "common/any_sequence.hpp"
#include "common/table.hpp"

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace nephroid::examples::study {

/// What is measured.
struct Options {
    std::string scene;                                                 ///< the name of a built-in case
    std::vector<std::string> methods;                                  ///< ids, in the order of the tables
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
};

/// How the answer is shown.
struct Presentation {
    std::filesystem::path output; ///< a folder for the figures, plots, pictures and the page
    TableFormat format = TableFormat::text;
    std::vector<std::string> tables; ///< names of those that are printed; none for the usual ones
    std::string command;             ///< as it was called
};

/// The words between commas. Throws UsageError for an empty one, which names the option.
[[nodiscard]] std::vector<std::string> listed(const std::string& option, const std::string& text);

/// "5000,2e4": counts of an option, growing, each once, from 100 to 1e8. Throws UsageError.
[[nodiscard]] std::vector<std::uint64_t> read_photon_counts(const std::string& text,
                                                            const std::string& option = "--photons");

/// "halton,random": kinds of --sequence, each once. Throws UsageError.
[[nodiscard]] std::vector<SequenceKind> read_sequences(const std::string& text);

/// The options of a command line that say what is measured on a built-in case.
class MeasuringArguments {
public:
    /// Where questions differ if nothing is said.
    struct Defaults {
        std::string photons, size;
        unsigned threads, repeats;
    };
    /// The app's options write here, so this must neither move nor end before it.
    MeasuringArguments(CLI::App& app, const Defaults& defaults);
    MeasuringArguments(const MeasuringArguments&) = delete;
    MeasuringArguments& operator=(const MeasuringArguments&) = delete;

    /// What was asked for; `scene` and `methods` are left to the question. Throws UsageError.
    [[nodiscard]] Options read() const;

private:
    std::string photons_, sequence_ = "halton,random", size_, seed_ = "0", fresnel_ = "off", reference_,
                          standard_error_;
    std::vector<double> view_;
    unsigned threads_, repeats_, samples_ = 1;
};

/// The options of a command line that say how the answer is shown.
class PresentationArguments {
public:
    /// @param tables  the names of all tables that there are
    PresentationArguments(CLI::App& app, std::vector<std::string> tables);
    PresentationArguments(const PresentationArguments&) = delete;
    PresentationArguments& operator=(const PresentationArguments&) = delete;

    /// @param output   the folder if none was named
    /// @param command  as the program was called
    /// Throws UsageError.
    [[nodiscard]] Presentation read(const std::string& output, const std::string& command) const;

private:
    std::vector<std::string> known_;
    std::string output_, tables_;
    bool markdown_ = false;
};

} // namespace nephroid::examples::study
