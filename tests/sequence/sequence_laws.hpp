// SPDX-License-Identifier: MIT
/// @file  What every sequence of sample points has to fulfil, beyond what the concept can ask the compiler.
#pragma once

#include "nephroid/sequence/sequence.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace nephroid::tests {

/// For a sequence type that is made from a seed. `dimensions`: how many to look at.
template <SampleSequence S>
void check_sequence_laws(std::uint32_t dimensions) {
    const S sequence{42};

    SUBCASE("samples are at least 0 and below 1, of float and of double alike") {
        const std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
        for (const std::uint64_t first : {std::uint64_t{0}, (std::uint64_t{1} << 24) - 50, most - 50,
                                          (std::uint64_t{1} << 40) - 50, (std::uint64_t{1} << 62) - 50}) {
            for (std::uint64_t i = first; i < first + 100; ++i) {
                for (std::uint32_t d = 0; d < dimensions; ++d) {
                    const double x = sequence.template sample<double>(i, d);
                    const float y = sequence.template sample<float>(i, d);
                    REQUIRE((x >= 0 && x < 1));
                    REQUIRE((y >= 0 && y < 1));
                    // The same number: cut off or rounded to 24 bits.
                    REQUIRE(std::abs(x - double(y)) <= std::ldexp(1.0, -24));
                }
            }
        }
    }

    SUBCASE("a sample depends on seed, index and dimension, not on what was asked before") {
        const S again{42}, other{43};
        int same = 0;
        for (std::uint64_t i = 1000; i-- > 0;) {
            for (std::uint32_t d = dimensions; d-- > 0;) {
                REQUIRE(again.template sample<double>(i, d) == S{42}.template sample<double>(i, d));
                same += again.template sample<float>(i, d) == other.template sample<float>(i, d) ? 1 : 0;
            }
        }
        // Floats have 2^24 values, so of 20000 pairs 0.001 agree by chance; a coordinate that ignored its seed: 1000.
        CHECK(same <= 5);
    }

    SUBCASE("over seeds each point is uniform") {
        // Mean of x over n seeds: 1/2 with standard deviation 1 / sqrt(12 n); of (x - 1/2)^2: 1/12 with
        // 1 / sqrt(180 n). 5 deviations: one failure in 1.7 million checks.
        const int n = 4096;
        for (const std::uint64_t i : {0u, 1u, 2u, 77u, 4095u}) {
            for (std::uint32_t d = 0; d < dimensions; ++d) {
                double sum = 0, sum2 = 0;
                for (std::uint64_t seed = 1; seed <= n; ++seed) {
                    const double x = S{seed}.template sample<double>(i, d) - 0.5;
                    sum += x;
                    sum2 += x * x;
                }
                CHECK(std::abs(sum / n) < 5 / std::sqrt(12.0 * n));
                CHECK(std::abs(sum2 / n - 1.0 / 12) < 5 / std::sqrt(180.0 * n));
            }
        }
    }

    SUBCASE("over seeds two coordinates of a point, and one coordinate of two random points, are uncorrelated") {
        // The product of two centred uniform numbers has standard deviation 1/12. Successive points of a stratified
        // sequence avoid each other, so the second check is for random ones alone.
        const int n = 4096;
        for (std::uint32_t d = 1; d < dimensions; ++d) {
            double between_dimensions = 0, between_points = 0;
            for (std::uint64_t seed = 1; seed <= n; ++seed) {
                const S s{seed};
                const double x = s.template sample<double>(5, d) - 0.5;
                between_dimensions += x * (s.template sample<double>(5, d - 1) - 0.5);
                between_points += x * (s.template sample<double>(6, d) - 0.5);
            }
            CHECK(std::abs(between_dimensions / n) < 5.0 / 12 / std::sqrt(double(n)));
            if constexpr (!S::stratified)
                CHECK(std::abs(between_points / n) < 5.0 / 12 / std::sqrt(double(n)));
        }
    }

    SUBCASE("within the first 4096 points no two dimensions are correlated") {
        // Independent ones: correlation 0 with standard deviation 1/64. A stratified pair has less, if anything.
        const std::size_t n = 4096;
        std::vector<std::vector<double>> x(dimensions, std::vector<double>(n));
        for (std::uint32_t d = 0; d < dimensions; ++d) {
            for (std::size_t i = 0; i < n; ++i)
                x[d][i] = sequence.template sample<double>(i, d) - 0.5;
        }
        for (std::uint32_t a = 0; a < dimensions; ++a) {
            for (std::uint32_t b = 0; b < a; ++b) {
                double sum = 0;
                for (std::size_t i = 0; i < n; ++i)
                    sum += x[a][i] * x[b][i];
                CHECK(std::abs(sum / double(n) * 12) < 5.0 / 64);
            }
        }
    }
}

/// Root of the mean, over 64 seeds, of the squared error of the integral of f over the cube, from the first n points.
template <SampleSequence S, class F>
double integration_error(F f, double exact, std::uint64_t n) {
    double sum2 = 0;
    for (std::uint64_t seed = 1; seed <= 64; ++seed) {
        const S sequence{seed};
        double sum = 0;
        for (std::uint64_t i = 0; i < n; ++i) {
            Sampler<S> sampler(sequence, i);
            sum += f(sampler);
        }
        const double error = sum / double(n) - exact;
        sum2 += error * error;
    }
    return std::sqrt(sum2 / 64);
}

/// The product of 1 + (x - 1/2) over four coordinates: smooth, with integral 1 and variance (13/12)^4 - 1.
inline constexpr auto product_of_four = [](auto& sampler) {
    double product = 1;
    for (int d = 0; d < 4; ++d)
        product *= 0.5 + sampler.template next<double>();
    return product;
};
} // namespace nephroid::tests
