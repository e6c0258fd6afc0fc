// SPDX-License-Identifier: MIT
#include "nephroid/receiver/pass_variance.hpp"

#include "nephroid/bounce/splat_global.hpp"
#include "nephroid/execution/thread_executor.hpp"
#include "nephroid/sequence/random.hpp"

#include "bounce/closed_rooms.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

namespace nephroid::tests::pass_variance_test {

using V = glm::vec3;

namespace {

struct Vertex {
    V position, normal;
};

[[nodiscard]] std::vector<Vertex> floor_of(std::size_t side) {
    std::vector<Vertex> vertices;
    for (std::size_t i = 0; i < side * side; ++i)
        vertices.push_back({{float(i % side), 0, float(i / side)}, {0, 1, 0}});
    return vertices;
}

/// Adds value() at every vertex.
template <class F, class Value>
void add(Sums<V, F>& sums, const Value& value) {
    const auto leaves = sums.map().tree().leaves();
    for (std::uint32_t leaf = 0; leaf < leaves.size(); ++leaf)
        for (std::size_t i = 0; i < leaves[leaf].size; ++i)
            sums.of_leaf(leaf)[i] = sums.of_leaf(leaf)[i] + value();
}

} // namespace

TEST_CASE("pass variance: of three passes is that of their mean by hand") {
    const auto vertices = floor_of(5);
    const EyePathMap map(vertices, &Vertex::position, &Vertex::normal);
    auto sums = nephroid::sums<V>(map);
    PassVariance<V, V> variance(map);
    CHECK(variance.relative_error() == std::numeric_limits<double>::infinity());
    for (const float power : {1.f, 3.f, 2.f}) {
        variance.for_each(
            [&](std::size_t, double, double of_mean) { CHECK(std::isinf(of_mean) == (variance.passes() < 2)); });
        add(sums, [&] { return V(0, power, 2 * power); }); // a colour's power is its mean
        variance.end_pass(sums);
    }
    CHECK(variance.passes() == 3);
    std::size_t told = 0;
    variance.for_each([&](std::size_t vertex, double mean, double of_mean) {
        CHECK(vertex < vertices.size());
        CHECK(mean == doctest::Approx(2).epsilon(1e-6));
        CHECK(of_mean == doctest::Approx(1.0 / 3).epsilon(1e-6)); // 1, 3 and 2: variance 1, over three passes
        ++told;
    });
    CHECK(told == vertices.size());
    CHECK(variance.relative_error() == doctest::Approx(std::sqrt(1.0 / 3) / 2).epsilon(1e-6));
    variance.clear();
    CHECK(variance.passes() == 0);
    const EyePathMap other(vertices, &Vertex::position, &Vertex::normal);
    CHECK_THROWS_AS(variance.end_pass(nephroid::sums<V>(other)), std::invalid_argument);
}

TEST_CASE("pass variance: passes that agree have none, and dark ones no relative error") {
    const auto vertices = floor_of(3);
    const EyePathMap map(vertices, &Vertex::position, &Vertex::normal);
    auto sums = nephroid::sums<float>(map);
    PassVariance<V, float> variance(map);
    for (int pass = 0; pass < 3; ++pass)
        variance.end_pass(sums);
    CHECK(std::isinf(variance.relative_error()));
    variance.clear();
    for (int pass = 0; pass < 100; ++pass) {
        add(sums, [] { return 0.1f; });
        variance.end_pass(sums);
    }
    CHECK(variance.relative_error() < 1e-6); // the sums round to 2^-24 of themselves in each pass
}

TEST_CASE("pass variance: of random values is how far their means lie from the truth") {
    const auto vertices = floor_of(60);
    const EyePathMap map(vertices, &Vertex::position, &Vertex::normal);
    auto sums = nephroid::sums<double>(map);
    PassVariance<V, double> variance(map);
    std::mt19937_64 random(7);
    std::exponential_distribution<double> value; // mean 1, variance 1, fourth moment about the mean 9
    constexpr double passes = 8;
    for (int pass = 0; pass < int(passes); ++pass) {
        add(sums, [&] { return value(random); });
        variance.end_pass(sums);
    }
    double estimated = 0, actual = 0;
    variance.for_each([&](std::size_t, double mean, double of_mean) {
        estimated += of_mean;
        actual += (mean - 1) * (mean - 1);
    });
    const double count = double(vertices.size());
    const double deviation = std::sqrt((9 - (passes - 3) / (passes - 1)) / passes) / passes; // of one vertex's estimate
    CHECK(std::abs(estimated / count - 1 / passes) < 4 * deviation / std::sqrt(count));
    // The square of a mean of 8 has relative variance 2 + 6/8: the excess of the kurtosis over 3, over the passes.
    CHECK(std::abs(actual / count - 1 / passes) < 4 * std::sqrt(2.75) / passes / std::sqrt(count));
}

// Two pictures of other photons differ by twice the variance. Vertices closer than a disk's radius of 0.1 are alike, so
// that the six walls have some 6/(π 0.1²) = 190 independent places. Their squares' mean is good to √(2/190) = 0.1,
// of which 3.5 times are allowed.
TEST_CASE("pass variance: of a room's indirect light is how two pictures of other photons differ") {
    const Room<float> room = furnace<float>();
    const auto lamp = room.glow(0.5f, {0, 1, 2, 3, 4, 5});
    const auto vertices = room.vertices(12, {0, 1, 2, 3, 4, 5});
    const auto map = map_of(vertices);
    const FreeDistances<V> distances(map, room);
    ThreadExecutor threads;
    std::vector<double> difference(vertices.size(), 0.0);
    double estimated = 0;
    for (const std::uint64_t seed : {1u, 2u}) {
        auto sums = nephroid::sums<float>(map);
        PassVariance<V, float> variance(map);
        for (std::uint64_t pass = 0; pass < 6; ++pass) {
            splat_global(room, lamp, sums, distances, {.first = pass * 2000, .count = 2000, .radius = 0.1},
                         RandomSequence(seed), threads);
            variance.end_pass(sums);
        }
        variance.for_each([&](std::size_t vertex, double mean, double of_mean) {
            difference[vertex] += seed == 1 ? mean : -mean;
            estimated += of_mean;
        });
    }
    double actual = 0;
    for (const double d : difference)
        actual += d * d;
    CHECK(actual / estimated == doctest::Approx(1).epsilon(0.35));
}

} // namespace nephroid::tests::pass_variance_test
