// SPDX-License-Identifier: MIT
#include "nephroid/execution/thread_executor.hpp"
#include "nephroid/gather/estimate_at.hpp"

#include "support/brute_force.hpp"

#include <doctest/doctest.h>

#include <deque>

namespace nephroid::tests::estimate_at_test {

using tests::Vertex;

namespace {

std::deque<Vertex<glm::dvec3>> vertices(int count) {
    std::deque<Vertex<glm::dvec3>> all;
    for (int i = 0; i < count; ++i)
        all.push_back({{i, 0, 0}, {0, 0, i % 2}});
    return all;
}

} // namespace

TEST_CASE("estimate at: every vertex is estimated once and handed over in order by one of several threads") {
    const auto all = vertices(1000);
    const auto estimate = [](const glm::dvec3& position, const glm::dvec3& normal) {
        return position.x + normal.z / 4;
    };
    const auto check = [&](auto&& executor) {
        std::size_t next = 0;
        const auto self = std::this_thread::get_id();
        estimate_at(all, &Vertex<glm::dvec3>::position, &Vertex<glm::dvec3>::normal, estimate, executor,
                    [&](std::size_t i, const double& e) {
                        CHECK(i == next++);
                        CHECK(e == double(i) + double(i % 2) / 4);
                        CHECK(std::this_thread::get_id() == self);
                    });
        CHECK(next == 1000);
    };
    check(SerialExecutor{});
    check(ThreadExecutor(3));
    ThreadExecutor kept(2);
    check(kept);
}

TEST_CASE("estimate at: without vertices does nothing") {
    estimate_at(
        vertices(0), &Vertex<glm::dvec3>::position, &Vertex<glm::dvec3>::normal,
        [](const glm::dvec3&, const glm::dvec3&) { return 1.0; }, SerialExecutor{},
        [](std::size_t, double) { FAIL("there is none"); });
}

} // namespace nephroid::tests::estimate_at_test
