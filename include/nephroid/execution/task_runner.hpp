// SPDX-License-Identifier: MIT
/// @file  Type erasure for executors and tasks: code that uses these types is compiled once for all executors.
#pragma once

#include "nephroid/execution/executor.hpp"

#include <concepts>
#include <cstddef>
#include <type_traits>

namespace nephroid::detail {

/// A reference to a task that can be called with an index. The task must outlive it. It compiles faster than a
/// std::function, which instantiates some twenty templates for every lambda.
class TaskReference {
public:
    template <class Work>
        requires(std::is_object_v<Work> && !std::same_as<std::remove_const_t<Work>, TaskReference>)
    explicit TaskReference(Work& work)
        : work_(&work),
          call_([](const void* target, std::size_t i) { (*static_cast<Work*>(const_cast<void*>(target)))(i); }) {}

    void operator()(std::size_t i) const { call_(work_, i); }

private:
    const void* work_;
    void (*call_)(const void* work, std::size_t i);
};

/// A reference to an executor, which must outlive it.
class TaskRunner {
public:
    template <Executor E>
        requires(!std::same_as<std::remove_const_t<E>, TaskRunner>)
    explicit TaskRunner(E& executor)
        : executor_(&executor), run_([](const void* target, std::size_t count, const TaskReference& task) {
              (*static_cast<E*>(const_cast<void*>(target)))(count, task);
          }),
          begin_(
              [](const void* target, Phase phase) { announce(*static_cast<E*>(const_cast<void*>(target)), phase); }) {}

    template <class Work>
    void operator()(std::size_t count, const Work& work) const {
        run_(executor_, count, TaskReference(work));
    }

    void begin(Phase phase) const { begin_(executor_, phase); }

private:
    const void* executor_;
    void (*run_)(const void* executor, std::size_t count, const TaskReference& task);
    void (*begin_)(const void* executor, Phase phase);
};

} // namespace nephroid::detail
