// SPDX-License-Identifier: MIT
/// @file  `study spectrum`: light moved by its tangent by wavelength, against brute force, a wavelength for each
/// photon,
///        three indices, and no dispersion.
#pragma once

#include "common/study/options.hpp"

namespace nephroid::examples::study::spectrum {

class Command {
public:
    /// Adds the options to the subcommand's app, which must not live longer.
    explicit Command(CLI::App& app);
    Command(const Command&) = delete;
    Command& operator=(const Command&) = delete;

    /// @param command  as the program was called
    /// Throws UsageError, std::runtime_error.
    void run(const std::string& command) const;

private:
    std::string walks_ = "2500,5000,10000,20000,40000,80000,160000,320000";
    unsigned threads_ = 1, size_ = 256;
    PresentationArguments presentation_;
};

} // namespace nephroid::examples::study::spectrum
