// SPDX-License-Identifier: MIT
/// @file  Who runs the work: the calling thread, a few of our own, or the renderer's pool.
#pragma once

#include "nephroid/version.hpp"

#include <algorithm>
#include <atomic>
#include <concepts>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <system_error>
#include <thread>
#include <type_traits>
#include <vector>

namespace nephroid {

/// `executor(count, task)` calls task(i) once for each i in 0 … count − 1, in any order and on any threads, and
/// returns when all are done. Results never depend on who runs what. oneTBB and OpenMP are adapted in three lines:
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

/// The same, for functions that take one by a forwarding reference E&&.
template <class E>
concept ExecutorArgument = Executor < std::remove_reference_t<E>
& > ;

/// An executor whose type does not matter: what is given one is compiled once.
using TaskRunner = std::function<void(std::size_t count, const std::function<void(std::size_t)>& task)>;

/// What an executor is called for.
enum class Phase { trace, fit, splat };

namespace detail {
/// Tells an executor that wants to know (to take times, say) what the next calls are for: a member `begin(Phase)`.
template <class E>
void announce(E& executor, Phase phase) {
    if constexpr (requires { executor.begin(phase); })
        executor.begin(phase);
}

/// The executor must outlive what is returned.
template <Executor E>
[[nodiscard]] TaskRunner run_by(E& executor) {
    return [&executor](std::size_t count, const std::function<void(std::size_t)>& task) { executor(count, task); };
}

/// Calls work(i) once for each i in 0 … count − 1, where a single one is too little for a task of its own.
///
/// @param per_task  how many neighbours make one, > 0
template <class E, class Work>
void for_each_index(E& executor, std::size_t count, std::size_t per_task, const Work& work) {
    const auto run = [&](std::size_t task) {
        const std::size_t end = (std::min)(count, (task + 1) * per_task);
        for (std::size_t i = task * per_task; i < end; ++i)
            work(i);
    };
    if (count <= per_task)
        run(0); // wakes nobody
    else
        executor((count + per_task - 1) / per_task, run);
}
} // namespace detail

/// All on the calling thread.
struct SerialExecutor {
    template <class Task>
    void operator()(std::size_t count, Task&& task) const {
        for (std::size_t i = 0; i < count; ++i)
            task(i);
    }
};

static_assert(Executor<SerialExecutor>);

/// A pool of std::threads that lives as long as the object; the calling thread works along. One call at a time, not
/// from within a task. An exception from a task is rethrown to the caller, once all tasks under way have ended; the
/// remaining ones are not begun.
class ThreadExecutor {
public:
    /// @param threads  in all, the caller's included; 0 takes what the hardware has. Where the system gives fewer,
    ///                 those do the work: `threads()` tells.
    explicit ThreadExecutor(unsigned threads = 0) {
        if (threads == 0)
            threads = (std::max)(1u, std::thread::hardware_concurrency());
        workers_.reserve(threads - 1);
        for (unsigned i = 1; i < threads; ++i)
            if (!begin_worker())
                break;
    }

    ThreadExecutor(const ThreadExecutor&) = delete;
    ThreadExecutor& operator=(const ThreadExecutor&) = delete;

    ~ThreadExecutor() {
        {
            const std::lock_guard lock(mutex_);
            stopping_ = true;
        }
        wake_.notify_all();
        for (std::thread& worker : workers_)
            worker.join();
    }

    [[nodiscard]] unsigned threads() const { return unsigned(workers_.size()) + 1; }

    template <class Task>
    void operator()(std::size_t count, Task&& task) {
        if (count == 0)
            return;
        {
            const std::lock_guard lock(mutex_);
            task_ = std::ref(task);
            count_ = count;
            next_.store(0, std::memory_order_relaxed);
            error_ = nullptr;
            busy_ = workers_.size();
            ++round_;
        }
        wake_.notify_all();
        work();
        std::unique_lock lock(mutex_);
        idle_.wait(lock, [this] { return busy_ == 0; });
        task_ = nullptr;
        rethrow();
    }

private:
    [[nodiscard]] bool begin_worker() {
#if defined(__cpp_exceptions)
        try {
            workers_.emplace_back([this] { serve(); });
        } catch (const std::system_error&) {
            return false;
        }
#else
        workers_.emplace_back([this] { serve(); });
#endif
        return true;
    }

    void serve() {
        std::size_t seen = 0;
        for (;;) {
            {
                std::unique_lock lock(mutex_);
                wake_.wait(lock, [&] { return stopping_ || round_ != seen; });
                if (stopping_)
                    return;
                seen = round_;
            }
            work();
            const std::lock_guard lock(mutex_);
            if (--busy_ == 0)
                idle_.notify_one();
        }
    }

    void work() {
        for (std::size_t i; (i = next_.fetch_add(1, std::memory_order_relaxed)) < count_;) {
#if defined(__cpp_exceptions)
            try {
                task_(i);
            } catch (...) {
                const std::lock_guard lock(mutex_);
                if (!error_)
                    error_ = std::current_exception();
                next_.store(count_, std::memory_order_relaxed);
            }
#else
            task_(i);
#endif
        }
    }

    void rethrow() {
#if defined(__cpp_exceptions)
        if (error_)
            std::rethrow_exception(error_);
#endif
    }

    std::mutex mutex_;
    std::condition_variable wake_, idle_;
    std::function<void(std::size_t)> task_;
    std::size_t count_ = 0;
    std::atomic<std::size_t> next_{0};
    std::exception_ptr error_;
    std::size_t busy_ = 0;
    std::size_t round_ = 0;
    bool stopping_ = false;
    std::vector<std::thread> workers_; // last: they use all of the above
};

static_assert(Executor<ThreadExecutor>);

} // namespace nephroid
