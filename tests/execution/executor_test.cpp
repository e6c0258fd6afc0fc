// SPDX-License-Identifier: MIT
#include "nephroid/execution/executor.hpp"

#include <doctest/doctest.h>

#include <vector>

namespace nephroid::tests::executor_test {

namespace {

static_assert(Executor<SerialExecutor> && Executor<const SerialExecutor&> && !Executor<int>);

/// An adapter, as for OpenMP or oneTBB.
struct Backwards {
    template <class Task>
    void operator()(std::size_t count, Task&& task) const {
        while (count > 0)
            task(--count);
    }
};
static_assert(Executor<Backwards>);

} // namespace

TEST_CASE("serial executor: runs every index once and in order") {
    std::vector<std::size_t> order;
    SerialExecutor{}(5, [&](std::size_t i) { order.push_back(i); });
    CHECK(order == std::vector<std::size_t>{0, 1, 2, 3, 4});
    SerialExecutor{}(0, [](std::size_t) { FAIL("ran"); });
}

TEST_CASE("executors: indices in groups are each met once and few wake nobody") {
    std::size_t calls = 0;
    const auto counting = [&](std::size_t count, auto&& task) {
        ++calls;
        SerialExecutor{}(count, task);
    };
    for (const std::size_t count : {0u, 1u, 9u, 10u, 11u, 19u, 20u, 21u, 100u}) {
        std::vector<int> met(count);
        calls = 0;
        detail::for_each_index(counting, count, 10, [&](std::size_t i) { ++met[i]; });
        CHECK(met == std::vector<int>(count, 1));
        CHECK(calls == (count > 10 ? 1 : 0));
    }
}

} // namespace nephroid::tests::executor_test
