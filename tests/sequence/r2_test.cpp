// SPDX-License-Identifier: MIT
#include "nephroid/sequence/r2.hpp"

#include "sequence/sequence_laws.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace nephroid::tests::r2_test {

namespace {
/// The real root of ρ³ = ρ + 1, by Cardano's formula.
long double plastic_number() {
    const long double root = std::sqrt(69.0L);
    return std::cbrt((9 + root) / 18) + std::cbrt((9 - root) / 18);
}

/// How far a number is from the next whole one.
double to_whole(double x) { return std::abs(x - std::round(x)); }
} // namespace

TEST_CASE("R2Sequence: is a sequence") { tests::check_sequence_laws<R2Sequence>(20); }

TEST_CASE("R2Sequence: the first points are those of the formula") {
    const long double rho = plastic_number();
    const R2Sequence sequence;
    for (std::uint64_t i = 0; i < 100'000; i += 7) {
        const long double x = 0.5L + (long double)(i + 1) / rho, y = 0.5L + (long double)(i + 1) / (rho * rho);
        // Rounding of long doubles up to 1e5 is 2^-48 at most, and samples are cut off at 2^-53.
        REQUIRE(to_whole(sequence.sample<double>(i, 0) - double(x - std::floor(x))) < std::ldexp(1.0, -47));
        REQUIRE(to_whole(sequence.sample<double>(i, 1) - double(y - std::floor(y))) < std::ldexp(1.0, -47));
    }
}

// Two points differ as the first does from one of those up to n, so that all distances are seen from one point.
TEST_CASE("R2Sequence: any n points keep their distance on the torus, wherever they begin") {
    for (const std::uint64_t seed : {0u, 3u}) {
        for (const std::uint64_t first : {std::uint64_t{0}, (std::uint64_t{1} << 62)}) {
            const R2Sequence sequence(seed);
            std::array<double, 6> origin{}, least{};
            least.fill(1);
            for (std::uint32_t d = 0; d < 6; ++d)
                origin[d] = sequence.sample<double>(first, d);
            for (std::uint64_t n = 1; n <= 200'000; ++n) {
                const auto by = [&](std::uint32_t d) {
                    return to_whole(sequence.sample<double>(first + n, d) - origin[d]);
                };
                const double across = std::hypot(by(0), by(1));
                least[0] = std::min(least[0], across * std::sqrt(double(n)));
                for (std::uint32_t d = 2; d < 6; ++d)
                    least[d] = std::min(least[d], std::hypot(across, by(d)) * std::cbrt(double(n)));
            }
            CHECK(least[0] > 0.49);
            for (std::uint32_t d = 2; d < 6; ++d)
                CHECK(least[d] > 0.42);
        }
    }
}

TEST_CASE("R2Sequence: a seed moves all points alike") {
    const R2Sequence plain, moved(5);
    for (const std::uint32_t d : {0u, 1u, 2u, 5u}) {
        const double by = moved.sample<double>(0, d) - plain.sample<double>(0, d);
        for (std::uint64_t i = 1; i < 1000; ++i)
            REQUIRE(to_whole(moved.sample<double>(i, d) - plain.sample<double>(i, d) - by) < std::ldexp(1.0, -51));
    }
}

TEST_CASE("R2Sequence: coordinates from the seventh on are Halton's") {
    const R2Sequence sequence(9);
    const HaltonSequence halton(9);
    for (std::uint64_t i = 0; i < 100; ++i) {
        for (std::uint32_t d = 6; d < 20; ++d)
            REQUIRE(sequence.sample<float>(i, d) == halton.sample<float>(i, d));
    }
}

// A product's error is, to first order, the sum of the errors of the coordinates' means. The mean of n multiples of an
// irrational step is off by a few 1/n [Kuipers and Niederreiter 1974], here taken as 2/n for each of four. Random
// numbers have sqrt(((13/12)^4 - 1)/n), five times as much for 4096.
TEST_CASE("R2Sequence: integrates a smooth function of four coordinates with an error of 8/n") {
    for (const std::uint64_t n : {1024u, 4096u})
        CHECK(integration_error<R2Sequence>(product_of_four, 1, n) < 8 / double(n));
}
} // namespace nephroid::tests::r2_test
