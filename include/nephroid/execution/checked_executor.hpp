// SPDX-License-Identifier: MIT
/// @file  Checks that an executor runs each task once. If it ran a task twice, the task could write beyond the end of
///        an array; if it skipped a task, photons would be lost silently.
#pragma once

#include "nephroid/execution/executor.hpp"
#include "nephroid/vector/error.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <memory>
#include <string>

namespace nephroid::detail {

/// Runs tasks by another executor, which must outlive it. It runs no task a second time. When all are done, it throws
/// std::invalid_argument if the other executor repeated or skipped a task. Costs a byte for each task.
template <Executor E>
class CheckedExecutor {
public:
    explicit CheckedExecutor(E& executor) : executor_(executor) {}

    template <class Task>
    void operator()(std::size_t count, Task&& task) {
        const std::unique_ptr<std::atomic<bool>[]> has_run(new std::atomic<bool>[count]());
        std::atomic<bool> runs_again{false};
        executor_(count, [&](std::size_t i) {
            if (i < count && !has_run[i].exchange(true, std::memory_order_relaxed))
                task(i);
            else
                runs_again.store(true, std::memory_order_relaxed);
        });
        const auto run = static_cast<std::size_t>(std::count(has_run.get(), has_run.get() + count, true));
        if (run < count)
            complain("ran " + std::to_string(run) + " of " + std::to_string(count) + " tasks before it returned");
        if (runs_again.load(std::memory_order_relaxed))
            complain("ran a task twice, or one beyond the last of " + std::to_string(count));
    }

    /// Announces the phase to the other executor.
    void begin(Phase phase) { announce(executor_, phase); }

private:
    [[noreturn]] static void complain(const std::string& what) {
        invalid_argument("nephroid: the executor " + what +
                         "; executor(count, task) must call task(i) once for each i below count, and then return");
    }

    E& executor_;
};

} // namespace nephroid::detail
