// SPDX-License-Identifier: MIT
#include "nephroid/receiver/checkpoint.hpp"

#include "support/untidy_scene.hpp"

#include "nephroid/caustics.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace nephroid::tests::checkpoint_test {

using V = glm::vec3;

namespace {

constexpr std::uint64_t photons = 2000, unit_of_work = 500, scene = 42;

template <class S>
void splat(S& sums, Statistics& account, std::uint64_t begin, std::uint64_t end) {
    for (std::uint64_t first = begin; first < end; first += unit_of_work)
        account += nephroid::caustics(untidy(), lamp<float>(1.2f), sums,
                                      {.first = first, .count = unit_of_work, .total = photons});
}

/// A checkpoint of sums that hold something.
struct Written {
    std::vector<Vertex<V>> vertices = ceiling<float>();
    EyePathMap<V> map = map_of(vertices);
    Sums<V, float> sums = nephroid::sums<float>(map);
    Statistics account;
    std::string bytes;

    Written() {
        splat(sums, account, 0, unit_of_work);
        bytes = checkpoint(sums, account, unit_of_work, scene);
    }
};

} // namespace

TEST_CASE_TEMPLATE("checkpoint: a picture resumed from it is that of a run in one, bit for bit", R, Irradiance,
                   InDouble<>, InWholeNumbers<>) {
    const R accumulator = [] {
        if constexpr (std::is_same_v<R, InWholeNumbers<>>)
            return R(1);
        else
            return R{};
    }();
    const auto vertices = ceiling<float>();
    const auto map = map_of(vertices);
    auto in_one = nephroid::sums<float>(map, accumulator);
    Statistics account;
    splat(in_one, account, 0, photons);
    CHECK(account[Fate::splatted].photons > 100);
    const std::string end = checkpoint(in_one, account, photons, scene);
    for (std::uint64_t stop = 0; stop <= photons; stop += unit_of_work) {
        CAPTURE(stop);
        std::string bytes;
        {
            auto sums = nephroid::sums<float>(map, accumulator);
            Statistics until_then;
            splat(sums, until_then, 0, stop);
            bytes = checkpoint(sums, until_then, stop, scene);
        }
        const auto same_map = map_of(vertices); // a new process makes its own
        auto sums = nephroid::sums<float>(same_map, accumulator);
        splat(sums, account, 0, unit_of_work); // what was there is replaced
        Statistics resumed;
        const std::uint64_t next = resume(bytes, sums, resumed, scene);
        CHECK(next == stop);
        splat(sums, resumed, next, photons);
        CHECK(checkpoint(sums, resumed, photons, scene) == end);
    }
}

TEST_CASE("checkpoint: every truncated and every damaged one is refused and changes nothing") {
    const Written written;
    auto sums = nephroid::sums<float>(written.map);
    Statistics account;
    const std::string before = checkpoint(sums, account, 0, scene);
    const auto is_refused = [&](const std::string& bytes) {
        CHECK_THROWS_AS((void)resume(bytes, sums, account, scene), std::invalid_argument);
    };
    for (std::size_t size = 0; size < written.bytes.size(); size += 97)
        is_refused(written.bytes.substr(0, size));
    is_refused(written.bytes.substr(0, written.bytes.size() - 1));
    is_refused(written.bytes + '\0');
    for (std::size_t at = 0; at < written.bytes.size(); at += at < 400 ? 1 : 101) {
        std::string damaged = written.bytes;
        damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
        is_refused(damaged);
    }
    CHECK(checkpoint(sums, account, 0, scene) == before);
    CHECK(resume(written.bytes, sums, account, scene) == unit_of_work);
}

TEST_CASE("checkpoint: of another scene, receiver, flux or accumulator is refused with a sentence") {
    const Written written;
    const auto refuses = [&](auto sums, std::uint64_t of_scene, const char* sentence) {
        Statistics account;
        CHECK_THROWS_WITH_AS((void)resume(written.bytes, sums, account, of_scene), doctest::Contains(sentence),
                             std::invalid_argument);
    };
    refuses(nephroid::sums<float>(written.map), scene + 1, "of another scene");
    refuses(nephroid::sums<float>(written.map, InDouble{}), scene, "another flux, accumulator or power");
    auto vertices = written.vertices;
    vertices.back().position.x += 0.001f;
    const auto moved = map_of(vertices);
    refuses(nephroid::sums<float>(moved), scene, "of another receiver");
    vertices = written.vertices;
    for (auto& vertex : vertices)
        vertex.position.x += 16;
    const auto all_moved = map_of(vertices); // by a power of two, so that nothing is rounded
    refuses(nephroid::sums<float>(all_moved), scene, "of another receiver");
    auto whole = nephroid::sums<float>(written.map, InWholeNumbers(1));
    auto brighter = nephroid::sums<float>(written.map, InWholeNumbers(4));
    Statistics account;
    CHECK_THROWS_WITH_AS((void)resume(checkpoint(whole, account, 0, scene), brighter, account, scene),
                         doctest::Contains("another flux, accumulator or power"), std::invalid_argument);
    CHECK_THROWS_WITH_AS((void)resume(std::string(10'000, 'x'), whole, account, scene),
                         doctest::Contains("no checkpoint"), std::invalid_argument);
}

TEST_CASE("checkpoint: of a receiver without vertices") {
    const std::vector<Vertex<V>> nothing;
    const auto map = map_of(nothing);
    auto sums = nephroid::sums<float>(map);
    Statistics account;
    account.rays = 7;
    const std::string bytes = checkpoint(sums, account, 3, scene);
    account = {};
    CHECK(resume(bytes, sums, account, scene) == 3);
    CHECK(account.rays == 7);
}

} // namespace nephroid::tests::checkpoint_test
