// SPDX-License-Identifier: MIT
/// @file  Measures times with Google Benchmark, in turn, so that a busy machine slows down all tasks alike; or counts
///        instructions with Valgrind, which do not depend on other processes.
#pragma once

#include <benchmark/benchmark.h>

#if __has_include(<valgrind/callgrind.h>) && __has_include(<unistd.h>)
#include <unistd.h>
#include <valgrind/callgrind.h>
#define NEPHROID_EXAMPLES_HAS_CALLGRIND
#endif

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace nephroid::examples::benchmarks {

/// How long to measure. The defaults are short; a quiet machine needs no more.
struct Effort {
    double seconds = 0.04;             ///< of each repetition, at least
    unsigned repetitions = 5;          ///< the shortest of these times counts, which other processes disturb least
    bool full = false;                 ///< the large sizes too
    bool instructions = false;         ///< counted instead of seconds
    std::uint64_t photons = 1'000'000; ///< of the long run
};

/// A task to be timed: each call of `run` does `items` pieces of work.
struct Task {
    double items;
    std::function<void()> run;
    bool threads = false; ///< measured by wall clock, because processor time is the sum over threads
};

/// Keeps the least time of each task; prints nothing.
class LeastTimes : public benchmark::BenchmarkReporter {
public:
    explicit LeastTimes(const std::vector<Task>& tasks)
        : tasks_(&tasks), seconds_(tasks.size(), std::numeric_limits<double>::infinity()) {}

    bool ReportContext(const Context&) override { return true; }
    void ReportRuns(const std::vector<Run>& runs) override {
        for (const Run& run : runs) {
            if (run.run_type != Run::RT_Iteration)
                continue;
            const auto task = std::size_t(std::stoul(run.run_name.function_name));
            const double seconds = (*tasks_)[task].threads ? run.real_accumulated_time : run.cpu_accumulated_time;
            seconds_[task] = (std::min)(seconds_[task], seconds / double(run.iterations) / (*tasks_)[task].items);
        }
    }
    [[nodiscard]] const std::vector<double>& seconds() const { return seconds_; }

private:
    const std::vector<Task>* tasks_;
    std::vector<double> seconds_;
};

/// Whether the program runs under `valgrind --tool=callgrind`, and was built to know.
[[nodiscard]] inline bool counts_instructions() {
#if defined(NEPHROID_EXAMPLES_HAS_CALLGRIND)
    return RUNNING_ON_VALGRIND != 0;
#else
    return false;
#endif
}

#if defined(NEPHROID_EXAMPLES_HAS_CALLGRIND)
/// The total of the last counts that Callgrind has written to its file in the working folder; removes the file.
[[nodiscard]] inline double take_count() {
    static int files = 0;
    const std::string name = "callgrind.out." + std::to_string(getpid()) + "." + std::to_string(++files);
    std::ifstream file(name);
    double count = std::numeric_limits<double>::quiet_NaN();
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("totals: "))
            count = std::stod(line.substr(8));
    std::remove(name.c_str());
    return count;
}
#endif

/// The instructions for one item of each task in its second run; the first run also allocates. Returned in billions, so
/// that an instruction counts as a nanosecond.
[[nodiscard]] inline std::vector<double> instructions_per_item([[maybe_unused]] const std::vector<Task>& tasks) {
    std::vector<double> counts;
#if defined(NEPHROID_EXAMPLES_HAS_CALLGRIND)
    for (const Task& task : tasks) {
        task.run();
        CALLGRIND_ZERO_STATS;
        task.run();
        CALLGRIND_DUMP_STATS;
        counts.push_back(1e-9 * take_count() / task.items);
    }
#endif
    return counts;
}

/// Seconds of processor time, or of wall clock if a task asks for it, for one item of each task.
[[nodiscard]] inline std::vector<double> seconds_per_item(const Effort& effort, const std::vector<Task>& tasks) {
    if (effort.instructions)
        return instructions_per_item(tasks);
    static const bool initialised = [] {
        std::array<char, 10> name{"benchmark"};
        std::array<char, 46> interleave{"--benchmark_enable_random_interleaving=true"};
        std::array<char*, 3> arguments{name.data(), interleave.data(), nullptr};
        int count = 2;
        benchmark::Initialize(&count, arguments.data());
        return true;
    }();
    (void)initialised;
    for (std::size_t i = 0; i < tasks.size(); ++i) {
        benchmark::RegisterBenchmark(std::to_string(i).c_str(),
                                     [&run = tasks[i].run](benchmark::State& state) {
                                         for (auto _ : state)
                                             run();
                                     })
            ->MinTime(effort.seconds)
            ->Repetitions(int(effort.repetitions));
    }
    LeastTimes times(tasks);
    benchmark::RunSpecifiedBenchmarks(&times);
    benchmark::ClearRegisteredBenchmarks();
    return times.seconds();
}

} // namespace nephroid::examples::benchmarks
