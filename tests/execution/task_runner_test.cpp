// SPDX-License-Identifier: MIT
#include "nephroid/execution/task_runner.hpp"

#include <doctest/doctest.h>

#include <functional>
#include <vector>

namespace nephroid::tests::task_runner_test {

namespace {

static_assert(Executor<detail::TaskRunner> && Executor<const detail::TaskRunner>);

/// As a renderer may have it: not a template, and told of the phases.
struct OfFunctions {
    std::vector<Phase> phases{};
    std::size_t calls = 0;

    void begin(Phase phase) { phases.push_back(phase); }
    void operator()(std::size_t count, const std::function<void(std::size_t)>& task) {
        ++calls;
        for (std::size_t i = 0; i < count; ++i)
            task(i);
    }
};

} // namespace

TEST_CASE("task reference: calls what it refers to and a copy of it does too") {
    std::vector<std::size_t> met;
    auto work = [&](std::size_t i) { met.push_back(i); };
    const detail::TaskReference task(work), copy = task;
    task(3);
    copy(5);
    CHECK(met == std::vector<std::size_t>{3, 5});

    auto counting = [count = std::size_t(0)](std::size_t i) mutable { return count += i; }; // changes its own state
    const detail::TaskReference counts(counting);
    counts(3);
    counts(4);
    CHECK(counting(0) == 7);
}

TEST_CASE("task runner: runs every index once by the executor that it refers to") {
    OfFunctions executor;
    const detail::TaskRunner runner(executor), copy = runner;
    std::vector<int> met(100);
    detail::for_each_index(runner, met.size(), 10, [&](std::size_t i) { ++met[i]; });
    CHECK(met == std::vector<int>(100, 1));
    CHECK(executor.calls == 1);
    copy(100, [&](std::size_t i) { ++met[i]; });
    CHECK(met == std::vector<int>(100, 2));
    CHECK(executor.calls == 2);
    runner(0, [](std::size_t) { FAIL("ran"); });
}

TEST_CASE("task runner: a constant executor and one that knows no phases will do") {
    const auto backwards = [](std::size_t count, auto&& task) {
        while (count > 0)
            task(--count);
    };
    const detail::TaskRunner runner(backwards);
    detail::announce(runner, Phase::splat);
    std::vector<std::size_t> order;
    runner(3, [&](std::size_t i) { order.push_back(i); });
    CHECK(order == std::vector<std::size_t>{2, 1, 0});
}

TEST_CASE("task runner: passes phases on") {
    OfFunctions executor;
    const detail::TaskRunner runner(executor);
    detail::announce(runner, Phase::trace);
    detail::announce(runner, Phase::fit);
    CHECK(executor.phases == std::vector<Phase>{Phase::trace, Phase::fit});
}

} // namespace nephroid::tests::task_runner_test
