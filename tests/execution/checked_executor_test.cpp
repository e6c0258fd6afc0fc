// SPDX-License-Identifier: MIT
#include "nephroid/execution/checked_executor.hpp"

#include <doctest/doctest.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace nephroid::tests::checked_executor_test {

namespace {

/// What a checked executor says of it; empty if nothing.
template <class E>
[[nodiscard]] std::string complaint_about(E executor, std::vector<int>& runs) {
    detail::CheckedExecutor checked(executor);
    try {
        checked(runs.size(), [&](std::size_t i) { ++runs.at(i); });
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return {};
}

} // namespace

TEST_CASE("checked executor: one that keeps its word is passed through") {
    for (const std::size_t count : {0u, 1u, 7u}) {
        std::vector<int> runs(count);
        CHECK(complaint_about(SerialExecutor{}, runs).empty());
        CHECK(runs == std::vector<int>(count, 1));
    }
}

TEST_CASE("checked executor: tasks that run twice do so once and are complained about") {
    const auto twice = [](std::size_t count, auto&& task) {
        for (std::size_t i = 0; i < 2 * count; ++i)
            task(i / 2);
    };
    std::vector<int> runs(5);
    CHECK(complaint_about(twice, runs).find("twice") != std::string::npos);
    CHECK(runs == std::vector<int>(5, 1));
}

TEST_CASE("checked executor: tasks left out or beyond the last are complained about") {
    const auto never = [](std::size_t, auto&&) {};
    std::vector<int> runs(5);
    CHECK(complaint_about(never, runs).find("ran 0 of 5 tasks") != std::string::npos);
    const auto one_more = [](std::size_t count, auto&& task) { SerialExecutor{}(count + 1, task); };
    CHECK(complaint_about(one_more, runs).find("beyond the last of 5") != std::string::npos);
    CHECK(runs == std::vector<int>(5, 1));
}

TEST_CASE("checked executor: phases are passed on") {
    struct Listener : SerialExecutor {
        int begun = 0;
        void begin(Phase) { ++begun; }
    } listener;
    detail::CheckedExecutor checked(listener);
    detail::announce(checked, Phase::trace);
    CHECK(listener.begun == 1);
}

} // namespace nephroid::tests::checked_executor_test
