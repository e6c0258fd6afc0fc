// SPDX-License-Identifier: MIT
/// @file  A progress bar on a terminal, with photons per second; silent when the output is piped.
#pragma once

#include <chrono>
#include <cstdint>

namespace nephroid::examples {

class Progress {
public:
    explicit Progress(std::uint64_t photons);
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    ~Progress(); ///< wipes the bar

    /// @param done  photons so far
    void show(std::uint64_t done);

private:
    using Clock = std::chrono::steady_clock;

    std::uint64_t photons_;
    bool on_terminal_;
    bool shown_ = false;
    Clock::time_point start_ = Clock::now(), last_ = start_;
};

} // namespace nephroid::examples
