// SPDX-License-Identifier: MIT
/// @file  An executor with threads of its own.
#pragma once

#include "nephroid/execution/task_runner.hpp"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace nephroid {

/// Runs tasks on a pool of std::threads, which lives as long as the object, and on the calling thread. One call at a
/// time, and none from within a task. An exception from a task is rethrown to the caller once all running tasks have
/// ended; the other tasks are not begun.
class ThreadExecutor {
public:
    /// @param threads  in all, the caller's included; 0 takes as many as the hardware has. Where the system gives
    ///                 fewer, those do the work: see `threads()`.
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
        const auto call = [&task](std::size_t i) { task(i); };
        run(count, detail::TaskReference(call));
    }

private:
    void run(std::size_t count, const detail::TaskReference& task) {
        if (count == 0)
            return;
        {
            const std::lock_guard lock(mutex_);
            task_ = &task;
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
                (*task_)(i);
            } catch (...) {
                const std::lock_guard lock(mutex_);
                if (!error_)
                    error_ = std::current_exception();
                next_.store(count_, std::memory_order_relaxed);
            }
#else
            (*task_)(i);
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
    const detail::TaskReference* task_ = nullptr;
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
