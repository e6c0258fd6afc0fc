// SPDX-License-Identifier: MIT
#include "nephroid/execution/thread_executor.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace nephroid::tests::thread_executor_test {

namespace {

static_assert(Executor<ThreadExecutor&> && !Executor<const ThreadExecutor&>);

template <class E>
void check_each_index_once(E& executor, std::size_t count) {
    // Plain integers: two threads with the same index are a data race that the thread sanitizer sees.
    std::vector<int> times(count);
    executor(count, [&](std::size_t i) { ++times.at(i); });
    CAPTURE(count);
    CHECK(std::all_of(times.begin(), times.end(), [](int n) { return n == 1; }));
}

} // namespace

TEST_CASE("thread executor: runs every index once and for many rounds for any number of threads") {
    for (const unsigned threads : {1u, 2u, 7u}) {
        ThreadExecutor executor(threads);
        CAPTURE(threads);
        CHECK(executor.threads() == threads);
        for (const std::size_t count : {0u, 1u, 2u, 6u, 7u, 8u, 1000u})
            for (int round = 0; round < 20; ++round)
                check_each_index_once(executor, count);
    }
}

TEST_CASE("thread executor: zero threads means as many as the hardware has") {
    ThreadExecutor executor;
    CHECK(executor.threads() >= 1);
    check_each_index_once(executor, 100);
}

TEST_CASE("thread executor: what tasks wrote is there when the call returns") {
    ThreadExecutor executor(4);
    std::vector<std::size_t> squares(500);
    for (int round = 0; round < 50; ++round) {
        executor(squares.size(), [&](std::size_t i) { squares[i] = i * i + std::size_t(round); });
        const std::size_t sum = std::accumulate(squares.begin(), squares.end(), std::size_t(0));
        REQUIRE(sum == std::size_t(499) * 500 * 999 / 6 + 500 * std::size_t(round));
    }
}

TEST_CASE("thread executor: tasks really run on several threads") {
    ThreadExecutor executor(3);
    std::mutex mutex;
    std::condition_variable all_here;
    std::set<std::thread::id> ids;
    // Each of three tasks waits for the other two: on fewer than three threads this would never end.
    executor(3, [&](std::size_t) {
        std::unique_lock lock(mutex);
        ids.insert(std::this_thread::get_id());
        all_here.notify_all();
        all_here.wait(lock, [&] { return ids.size() == 3; });
    });
    CHECK(ids.count(std::this_thread::get_id()) == 1); // the caller works along
}

TEST_CASE("thread executor: an exception reaches the caller and the pool goes on") {
    for (const unsigned threads : {1u, 2u, 7u}) {
        CAPTURE(threads);
        ThreadExecutor executor(threads);
        for (int round = 0; round < 20; ++round) {
            std::atomic<int> ran{0};
            const auto run = [&] {
                executor(1000, [&](std::size_t i) {
                    ++ran;
                    if (i == 10)
                        throw std::runtime_error("task 10");
                });
            };
            CHECK_THROWS_WITH_AS(run(), "task 10", std::runtime_error);
            CHECK(ran >= 1);
            check_each_index_once(executor, 100);
        }
        // From every task at once: one of them.
        CHECK_THROWS_AS(executor(50, [](std::size_t i) { throw std::out_of_range(std::to_string(i)); }),
                        std::out_of_range);
        check_each_index_once(executor, 100);
    }
}

TEST_CASE("thread executor: after an exception the remaining tasks are not begun") {
    ThreadExecutor executor(1);
    int ran = 0;
    const auto run = [&] {
        executor(1000, [&](std::size_t) {
            ++ran;
            throw std::runtime_error("first");
        });
    };
    CHECK_THROWS_AS(run(), std::runtime_error);
    CHECK(ran == 1);
}

TEST_CASE("thread executor: a task may be an object that is called by reference") {
    struct Counter {
        std::atomic<int> calls{0};
        void operator()(std::size_t) { ++calls; }
    } counter; // cannot be copied
    ThreadExecutor executor(2);
    executor(100, counter);
    CHECK(counter.calls == 100);
}

TEST_CASE("thread executor: lives and dies without work") {
    for (int i = 0; i < 20; ++i)
        ThreadExecutor executor(3);
}

} // namespace nephroid::tests::thread_executor_test
