// SPDX-License-Identifier: MIT
/// @file  The concept of an executor, which runs the work: on the calling thread, our threads or the renderer's pool.
#pragma once

#include "nephroid/vector/language.hpp"

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <type_traits>

namespace nephroid {

/// `executor(count, task)` calls task(i) once for each i in 0 … count − 1, in any order and on any threads, and
/// returns when all are done. Results never depend on which thread runs what. oneTBB and OpenMP are adapted in three
/// lines:
///
/// ```cpp
/// const auto tbb = [](std::size_t count, auto&& task) { tbb::parallel_for(std::size_t(0), count, task); };
/// const auto openmp = [](std::size_t count, auto&& task) {
///     #pragma omp parallel for schedule(dynamic)
///     for (std::size_t i = 0; i < count; ++i)
///         task(i);
/// };
/// ```
template <class E>
concept Executor = requires(E executor, std::size_t count, void (*task)(std::size_t)) {
    executor(count, task);
};

/// The same, for parameters that are forwarding references E&&.
template <class E>
concept ExecutorArgument = Executor < std::remove_reference_t<E>
& > ;

/// The phases of a pass, for which an executor is called.
enum class Phase { trace, fit, splat };

namespace detail {
template <class E>
consteval bool explain_executor() {
    static_assert(ExecutorArgument<E>, "nephroid: the executor cannot be called as executor(count, task) "
                                       "(execution/executor.hpp)");
    return false;
}

/// For functions: an executor, or an error that says why not.
template <class E>
concept MustBeExecutor = ExecutorArgument<E> || explain_executor<E>();

/// Tells an executor which phase the next calls belong to, if it has a member `begin(Phase)` (to take times, say).
template <class E>
void announce(E& executor, Phase phase) {
    if constexpr (requires { executor.begin(phase); })
        executor.begin(phase);
}

/// Calls work(i) once for each i in 0 … count − 1, where one index is too little work for a task of its own.
///
/// @param per_task  how many successive indices make a task, > 0
template <class E, class Work>
void for_each_index(E& executor, std::size_t count, std::size_t per_task, const Work& work) {
    const auto run = [&](std::size_t task) {
        const std::size_t end = (std::min)(count, (task + 1) * per_task);
        for (std::size_t i = task * per_task; i < end; ++i)
            work(i);
    };
    if (count <= per_task)
        run(0); // wakes no other thread
    else
        executor((count + per_task - 1) / per_task, run);
}
} // namespace detail

/// Runs all tasks on the calling thread, in order.
struct SerialExecutor {
    template <class Task>
    void operator()(std::size_t count, Task&& task) const {
        for (std::size_t i = 0; i < count; ++i)
            task(i);
    }
};

static_assert(Executor<SerialExecutor>);

} // namespace nephroid
