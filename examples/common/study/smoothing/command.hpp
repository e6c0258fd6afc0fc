// SPDX-License-Identifier: MIT
/// @file  `study smoothing`: second-order splatting, which chooses its footprints, against first order at the best
///        smoothing there is, on cases whose caustics are known exactly.
#pragma once

#include "common/study/options.hpp"

namespace nephroid::examples::study::smoothing {

struct Options {
    std::vector<std::string> cases; ///< never empty
    study::Options each;            ///< of every case; its `scene` is filled in case by case
    double fixed_smoothing;         ///< s of the splats that are neither swept nor chosen
};

class Command {
public:
    /// Adds the options to the subcommand's app, which must not live longer.
    explicit Command(CLI::App& app);
    Command(const Command&) = delete;
    Command& operator=(const Command&) = delete;

    /// What was asked for. Throws UsageError.
    [[nodiscard]] Options options() const;

    /// @param command  as the program was called
    /// Throws UsageError, std::runtime_error.
    void run(const std::string& command) const;

private:
    std::string cases_;
    double fixed_smoothing_;
    MeasuringArguments measuring_;
    PresentationArguments presentation_;
};

} // namespace nephroid::examples::study::smoothing
