// SPDX-License-Identifier: MIT
#include "nephroid/quality/exponential_sums.hpp"

#include "nephroid/execution/thread_executor.hpp"
#include "nephroid/sequence/random.hpp"

#include <doctest/doctest.h>

#include <complex>
#include <cstring>
#include <vector>

namespace nephroid::tests::exponential_sums_test {

using namespace nephroid::detail;

namespace {

[[nodiscard]] std::vector<WeightedPoint> random_points(std::size_t count, std::uint64_t seed) {
    const RandomSequence random(seed);
    std::vector<WeightedPoint> points;
    for (std::size_t i = 0; i < count; ++i)
        points.push_back({random.sample<double>(i, 0), random.sample<double>(i, 1), random.sample<double>(i, 2)});
    return points;
}

[[nodiscard]] std::complex<long double> transform(const std::vector<WeightedPoint>& points, int i, int j) {
    const long double turn = 2 * std::numbers::pi_v<long double>;
    std::complex<long double> sum = 0;
    for (const WeightedPoint& p : points)
        sum += std::polar<long double>(p.weight,
                                       -turn * (i * static_cast<long double>(p.x) + j * static_cast<long double>(p.y)));
    return sum;
}

} // namespace

// A float holds sin and cos to 6e-8 and 64 of them are summed with as many roundings, each at most 64 * 6e-8, mostly
// of either sign: 7 blocks stay below 7 * 64 * 64 * 6e-8 = 2e-3 at worst, below 1e-4 in practice.
TEST_CASE("trigonometric_sums: give the transform at both signs of the second frequency as summed one by one") {
    const auto points = random_points(7 * 64 - 5, 1); // the last block is not full
    const std::size_t highest = 37;                   // no multiple of the rows and lanes that are done together
    const auto sums = trigonometric_sums(points, highest);
    REQUIRE(sums.size() == (highest + 1) * (highest + 1));
    double worst = 0;
    std::size_t beyond = 0;
    for (int i = 0; i <= 37; ++i)
        for (int j = 0; j <= 37; ++j) {
            const TrigonometricSums& sum = sums[static_cast<std::size_t>(i * 38 + j)];
            if (i * i + j * j > 37 * 37) {
                beyond += sum.cc != 0 || sum.ss != 0;
                continue;
            }
            const auto error = [&](double square, int sign) {
                return std::abs(std::sqrt(square) - static_cast<double>(std::abs(transform(points, i, sign * j))));
            };
            worst = (std::max)({worst, error(sum.square(), 1), error(sum.mirrored_square(), -1)});
        }
    CHECK(worst < 1e-4);
    CHECK(beyond == 0);
}

TEST_CASE("trigonometric_sums: are the same bits for any number of threads") {
    const auto points = random_points(500, 2);
    const auto alone = trigonometric_sums(points, 40);
    ThreadExecutor threads(3);
    const auto together = trigonometric_sums(points, 40, threads);
    CHECK(std::memcmp(alone.data(), together.data(), alone.size() * sizeof(TrigonometricSums)) == 0);
}

TEST_CASE("trigonometric_sums: of no points are zero and at frequency zero they are the weights' sum") {
    const auto none = trigonometric_sums({}, 3);
    CHECK(none.size() == 16);
    CHECK(none[0].square() == 0);
    const std::vector<WeightedPoint> points = {{0.25, 0.5, 2}, {0.75, 0.125, 0.5}};
    CHECK(trigonometric_sums(points, 0).front().cc == 2.5);
}

} // namespace nephroid::tests::exponential_sums_test
