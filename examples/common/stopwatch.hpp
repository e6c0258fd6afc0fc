// SPDX-License-Identifier: MIT
/// @file  Measures seconds of wall clock: a stopwatch, and an executor that times the phases of a pass.
#pragma once

#include "nephroid/execution/thread_executor.hpp"

#include <chrono>
#include <utility>

namespace nephroid::examples {

/// Seconds since construction or the last call of `lap`.
class Stopwatch {
public:
    [[nodiscard]] double lap() {
        const auto now = Clock::now();
        return std::chrono::duration<double>(now - std::exchange(start_, now)).count();
    }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
};

/// Measures the time of each phase that `splat_caustics` announces.
class TimingExecutor {
public:
    explicit TimingExecutor(ThreadExecutor& threads) : threads_(&threads) {}

    void begin(Phase phase) { phase_ = phase; }

    template <class Task>
    void operator()(std::size_t count, Task&& task) {
        Stopwatch stopwatch;
        (*threads_)(count, std::forward<Task>(task));
        (phase_ == Phase::trace ? trace_ : phase_ == Phase::fit ? fit_ : splat_) += stopwatch.lap();
    }

    [[nodiscard]] double trace_seconds() const { return trace_; }
    [[nodiscard]] double fit_seconds() const { return fit_; } ///< of footprints to neighbouring photons
    [[nodiscard]] double splat_seconds() const { return splat_; }

private:
    ThreadExecutor* threads_;
    Phase phase_ = Phase::trace;
    double trace_ = 0, fit_ = 0, splat_ = 0;
};

} // namespace nephroid::examples
