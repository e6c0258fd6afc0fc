// SPDX-License-Identifier: MIT
/// @file  `study compare`: photon differential splatting and its rivals, error against bandwidth, photons and time.
#pragma once

#include "common/study/options.hpp"

namespace nephroid::examples::study::compare {

class Command {
public:
    /// Adds the options to the subcommand's app, which must not live longer.
    explicit Command(CLI::App& app);
    Command(const Command&) = delete;
    Command& operator=(const Command&) = delete;

    /// What was asked for. Throws UsageError.
    [[nodiscard]] Options options() const;
    [[nodiscard]] Presentation presentation(const std::string& command) const;

    /// @param command  as the program was called
    /// Throws UsageError, std::runtime_error.
    void run(const std::string& command) const;

private:
    std::string scene_, methods_;
    bool sweep_ = false;
    MeasuringArguments measuring_;
    PresentationArguments presentation_;
};

} // namespace nephroid::examples::study::compare
