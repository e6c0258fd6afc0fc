// SPDX-License-Identifier: MIT
/// @file  `study relax`: the photons of test patterns, guide images, built-in caustics or glTF scenes relaxed into blue
///        noise, before and after: pictures, errors, edges, spectra; or what relaxing costs.
#pragma once

#include "common/study/options.hpp"
#include "common/study/relax/options.hpp"

namespace nephroid::examples::study::relax {

class Command {
public:
    /// Adds the options to the subcommand's app, which must not live longer.
    explicit Command(CLI::App& app);
    Command(const Command&) = delete;
    Command& operator=(const Command&) = delete;

    /// What was asked for, subject by subject. Throws UsageError.
    [[nodiscard]] std::vector<Options> options() const { return arguments_.read(); }

    /// @param command  as the program was called
    /// Throws UsageError, std::runtime_error.
    void run(const std::string& command) const;

private:
    Arguments arguments_;
    PresentationArguments presentation_;
};

} // namespace nephroid::examples::study::relax
