// SPDX-License-Identifier: MIT
/// @file  Executors and tasks of any kind behind one type each: code that is given these is compiled once for all.
#pragma once

#include "nephroid/execution/executor.hpp"

#include <concepts>
#include <cstddef>
#include <type_traits>

namespace nephroid::detail {

/// Something that can be called with an index. Refers to it: valid as long as that lives. Cheaper to compile than a
/// std::function, which is made of some twenty templates for every lambda.
class TaskReference {
public:
    template <class Work>
        requires(std::is_object_v<Work> && !std::same_as<std::remove_const_t<Work>, TaskReference>)
    explicit TaskReference(Work& work)
        : work_(&work),
          call_([](const void* its, std::size_t i) { (*static_cast<Work*>(const_cast<void*>(its)))(i); }) {}

    void operator()(std::size_t i) const { call_(work_, i); }

private:
    const void* work_;
    void (*call_)(const void* work, std::size_t i);
};

/// An executor that another one runs. Refers to that: valid as long as it lives.
class TaskRunner {
public:
    template <Executor E>
        requires(!std::same_as<std::remove_const_t<E>, TaskRunner>)
    explicit TaskRunner(E& executor)
        : executor_(&executor), run_([](const void* its, std::size_t count, const TaskReference& task) {
              (*static_cast<E*>(const_cast<void*>(its)))(count, task);
          }),
          begin_([](const void* its, Phase phase) { announce(*static_cast<E*>(const_cast<void*>(its)), phase); }) {}

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
