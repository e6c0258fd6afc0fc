// SPDX-License-Identifier: MIT
#include "nephroid/receiver/sums.hpp"

#include "support/untidy_scene.hpp"

#include "nephroid/caustics.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <span>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace nephroid::tests::sums_test {

using V = glm::vec3;

static_assert(std::is_trivially_copyable_v<Statistics>); // so that MPI and files can carry it as bytes

namespace {

constexpr std::uint64_t photons = 3000;

/// Splats the photons from one index to another.
template <class S>
Statistics splat(S& sums, std::uint64_t begin, std::uint64_t end) {
    return nephroid::caustics(untidy(), lamp<float>(1.2f), sums,
                              {.first = begin, .count = end - begin, .total = photons});
}

template <class S>
auto values_of(const S& sums) {
    return std::vector<typename S::number>(sums.values().begin(), sums.values().end());
}

} // namespace

TEST_CASE("sums: whole numbers are the same bits for any parts of a pass in any order") {
    const auto vertices = ceiling<float>();
    const auto map = map_of(vertices);
    const InWholeNumbers<> options(1);
    auto whole = nephroid::sums<float>(map, options);
    const Statistics account = splat(whole, 0, photons);
    CHECK(account[Fate::splatted].photons > 200);
    CHECK(whole.overflows() == 0);
    CHECK(std::any_of(whole.values().begin(), whole.values().end(), [](std::int64_t sum) { return sum > 0; }));
    for (const std::uint64_t ranks : {2u, 3u, 7u}) {
        CAPTURE(ranks);
        auto together = nephroid::sums<float>(map, options);
        Statistics accounts;
        for (std::uint64_t rank = ranks; rank-- > 0;) { // the last one first
            auto part = nephroid::sums<float>(map, options);
            accounts += splat(part, photons * rank / ranks, photons * (rank + 1) / ranks);
            together.add(part.values());
        }
        CHECK(values_of(together) == values_of(whole));
        CHECK(image_of(together) == image_of(whole));
        CHECK(accounts.rays == account.rays);
        CHECK(accounts[Fate::splatted].photons == account[Fate::splatted].photons);
        CHECK(accounts[Fate::splatted].flux == doctest::Approx(account[Fate::splatted].flux).epsilon(1e-12));
    }
}

TEST_CASE("sums: every accumulator gives the same picture to rounding") {
    const auto vertices = ceiling<float>();
    const auto map = map_of(vertices);
    auto plain = nephroid::sums<float>(map);
    auto exact = nephroid::sums<float>(map, InDouble{});
    auto whole = nephroid::sums<float>(map, InWholeNumbers(1));
    splat(plain, 0, photons);
    splat(exact, 0, photons);
    splat(whole, 0, photons);
    const auto a = image_of(plain), b = image_of(exact), c = image_of(whole);
    const float brightest = *std::max_element(a.begin(), a.end());
    CHECK(brightest > 0);
    for (std::size_t i = 0; i < a.size(); ++i) {
        // Float adds some hundred splats with half an ulp of the sum each: 300 · 6e-8 = 1.8e-5.
        CHECK(std::abs(a[i] - b[i]) <= 2e-5f * brightest);
        // Some 1,700 slots leave a unit of 2⁻⁴⁰, as power and diagonal² are about 1. Half of it for each of a
        // thousand splats is 5e-10, and two results are rounded to float.
        CHECK(std::abs(b[i] - c[i]) <= std::numeric_limits<float>::epsilon() * b[i] + 1e-9f);
    }
}

TEST_CASE("sums: a response scales what any accumulator adds") {
    const auto vertices = ceiling<float>();
    const auto map = map_of(vertices);
    const auto half = [](std::size_t, const V&) { return 0.5f; };
    auto plain = nephroid::sums<float>(map, InWholeNumbers(1));
    auto halved = nephroid::sums<float>(map, InWholeNumbers(1, half));
    auto in_double = nephroid::sums<float>(map, InDouble{half});
    splat(plain, 0, photons);
    splat(halved, 0, photons);
    splat(in_double, 0, photons);
    const auto a = image_of(plain), b = image_of(halved), c = image_of(in_double);
    for (std::size_t i = 0; i < a.size(); ++i) {
        CHECK(b[i] == doctest::Approx(a[i] / 2).epsilon(1e-6));
        CHECK(c[i] == doctest::Approx(a[i] / 2).epsilon(1e-6));
    }
}

TEST_CASE("sums: a colour's bands are added each by itself and rounded once") {
    const auto vertices = ceiling<float>();
    const auto map = map_of(vertices);
    auto whole = nephroid::sums<V>(map, InWholeNumbers(1));
    auto exact = nephroid::sums<V>(map, InDouble{});
    CHECK(whole.values().size() == 3 * map.tree().slots());
    std::minstd_rand random(5);
    std::vector<V> parts(1000);
    for (V& part : parts)
        part = V(float(random()), float(random()), -float(random())) * 1e-10f;
    const std::size_t slot = map.tree().leaves()[0].first;
    for (const V& part : parts) {
        whole.add(slot, part);
        exact.add(slot, part);
    }
    auto backwards = nephroid::sums<V>(map, InWholeNumbers(1));
    std::reverse(parts.begin(), parts.end());
    for (const V& part : parts)
        backwards.add(slot, part);
    CHECK(values_of(whole) == values_of(backwards));
    for (int band = 0; band < 3; ++band) // a thousand roundings by half a unit below 2⁻³⁹, and one to float
        CHECK(double(whole.at(slot)[band]) == doctest::Approx(double(exact.at(slot)[band])).epsilon(1e-6));
    CHECK(whole.at(slot).z < 0);
}

TEST_CASE("sums: what leaves the range of whole numbers stays at its end and is counted") {
    const auto vertices = ceiling<float>();
    const auto map = map_of(vertices);
    const float huge = 1e30f, none = std::numeric_limits<float>::quiet_NaN();
    for (const float beyond : {huge, -huge, none}) {
        auto sums = nephroid::sums<float>(map, InWholeNumbers(1));
        const std::size_t slot = map.tree().leaves()[0].first;
        sums.add(slot, beyond);
        CHECK(sums.overflows() == 1);
        const float end = sums.at(slot);
        CHECK(std::abs(end) > 8); // 2⁵⁶ units of 2⁻⁴⁰ power / diagonal²
        CHECK(std::isfinite(end));
        sums.add(slot, -end);
        CHECK(sums.at(slot) == end);
        for (int rank = 0; rank < 126; ++rank) // as MPI_SUM adds
            sums.values()[slot] += sums.values()[slot] > 0 ? std::int64_t(1) << 56 : -(std::int64_t(1) << 56);
        CHECK(sums.overflows() == 1);
        CHECK(sums.at(slot) == end);
        sums.clear();
        CHECK(sums.overflows() == 0);
        CHECK(sums.at(slot) == 0);
    }
}

TEST_CASE("sums: all light at one vertex fits, however many vertices there are") {
    std::vector<Vertex<V>> vertices;
    add_lattice<float>(vertices, 300, 300, 0.01, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
    const auto map = map_of(vertices);
    auto sums = nephroid::sums<float>(map, InWholeNumbers(100));
    const float all = 100 / (0.01f * 0.01f); // the lamp's power on one vertex's area
    const std::size_t slot = map.tree().leaves()[7].first;
    for (int photon = 0; photon < 1000; ++photon)
        sums.add(slot, all / 1000);
    CHECK(sums.overflows() == 0);
    CHECK(sums.at(slot) == doctest::Approx(all).epsilon(1e-5));
}

TEST_CASE("sums: refuse another receiver's values and a power that is none") {
    const auto vertices = ceiling<float>();
    const auto map = map_of(vertices);
    auto sums = nephroid::sums<float>(map);
    const std::vector<float> too_few(3);
    CHECK_THROWS_WITH_AS(sums.add(std::span<const float>(too_few.data(), too_few.size())),
                         doctest::Contains("3 values for"), std::invalid_argument);
    for (const double power : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::nan("")})
        CHECK_THROWS_WITH_AS((void)nephroid::sums<float>(map, InWholeNumbers(power)),
                             doctest::Contains("InWholeNumbers: power is"), std::invalid_argument);
}

TEST_CASE("sums: of a receiver without vertices, and of one without extent") {
    const std::vector<Vertex<V>> nothing, single{{{1, 2, 3}, {0, 0, 1}}};
    const auto empty_map = map_of(nothing);
    const auto empty = nephroid::sums<float>(empty_map, InWholeNumbers(1));
    CHECK(empty.values().empty());
    const auto map = map_of(single);
    auto sums = nephroid::sums<float>(map, InWholeNumbers(1));
    sums.add(0, 0.25f);
    CHECK(sums.at(0) == 0.25f);
}

} // namespace nephroid::tests::sums_test
