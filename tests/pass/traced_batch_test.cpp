// SPDX-License-Identifier: MIT
#include "nephroid/pass/traced_batch.hpp"

#include "nephroid/emission/light/directional.hpp"
#include "nephroid/execution/thread_executor.hpp"
#include "nephroid/sequence/halton.hpp"
#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>

#include <stdexcept>

namespace nephroid::tests::traced_batch_test {

namespace {

using Vec = glm::vec3;

DirectionalLight<Vec, float> sun() {
    return DirectionalLight<Vec, float>(
        {.direction = {0, 0, -1}, .irradiance = 1, .patch = Parallelogram<Vec>{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}});
}

/// What is kept of photon i: enough to tell it from all others, and fluxes whose sum depends on the order of adding.
struct Note {
    std::uint64_t number = 0;
};

Note note(std::uint64_t i, Statistics& account) {
    ++account.emitted.photons;
    account.end(Fate::splatted, 1 / (1 + double(i)));
    return {3 * i + 1};
}

} // namespace

TEST_CASE("traced batch: each photon is traced once and stored at its index") {
    SerialExecutor executor;
    detail::TracedBatch<Note> batch;
    for (const std::uint64_t count : {1u, 15u, 17u, 1000u, 5000u, 64u}) {
        const std::uint64_t begin = 1000 * count;
        std::vector<unsigned> traced(count);
        const Statistics account = batch.trace(
            sun(), HaltonSequence{}, 77, begin, begin + count,
            [&](std::uint64_t i, Statistics& its) {
                ++traced[i - begin];
                return note(i, its);
            },
            executor);
        for (std::uint64_t i = begin; i < begin + count; ++i) {
            REQUIRE(traced[i - begin] == 1);
            REQUIRE(batch[i].number == 3 * i + 1);
        }
        CHECK(account.emitted.photons == count);
        CHECK(account[Fate::splatted].photons == count);
    }
}

TEST_CASE("traced batch: the account of several threads is the same bit for bit") {
    const auto account = [](auto&& executor) {
        detail::TracedBatch<Note> batch;
        return batch.trace(sun(), HaltonSequence{}, 0, 0, 20'000, note, executor);
    };
    const Statistics one = account(SerialExecutor{}), three = account(ThreadExecutor(3));
    CHECK(one[Fate::splatted].flux == three[Fate::splatted].flux);
    CHECK(one[Fate::splatted].excess == three[Fate::splatted].excess);
}

TEST_CASE("traced batch: an exception from a thread reaches the caller and the next batch is whole") {
    ThreadExecutor executor(2);
    detail::TracedBatch<Note> batch;
    const auto fails = [](std::uint64_t i, Statistics& account) {
        if (i == 321)
            throw std::runtime_error("no such photon");
        return note(i, account);
    };
    CHECK_THROWS_WITH_AS(batch.trace(sun(), HaltonSequence{}, 0, 0, 500, fails, executor), "no such photon",
                         std::runtime_error);
    const Statistics account = batch.trace(sun(), HaltonSequence{}, 0, 500, 900, note, executor);
    CHECK(account.emitted.photons == 400);
    CHECK(batch[899].number == 3 * 899 + 1);
}

} // namespace nephroid::tests::traced_batch_test
