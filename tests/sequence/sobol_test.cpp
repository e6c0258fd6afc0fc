// SPDX-License-Identifier: MIT
#include "nephroid/sequence/sobol.hpp"

#include "sequence/sequence_laws.hpp"

#include "nephroid/sequence/hash.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <vector>

namespace nephroid::tests::sobol_test {

using detail::nested_uniform_scramble;

namespace {

/// One coordinate by Sobol's recurrence on the integers m_i, with the polynomial's coefficients one by one and bits
/// added one by one, apart from the library: sum over the index's bits i of m_i / 2^i, without carry.
std::uint32_t slow_sobol(std::uint32_t index, std::uint32_t dimension) {
    std::vector<std::uint64_t> m(33, 1); // m[i] has i bits; dimension 0 has m_i = 1 throughout
    if (dimension > 0) {
        const auto& d = detail::joe_kuo[dimension - 1];
        for (std::uint32_t i = 1; i <= 32; ++i) {
            if (i <= d.degree) {
                m[i] = d.directions[i - 1];
                continue;
            }
            m[i] = m[i - d.degree] ^ (m[i - d.degree] << d.degree);
            for (std::uint32_t k = 1; k < d.degree; ++k) {
                const std::uint32_t a_k = d.coefficients >> (d.degree - 1 - k) & 1u;
                m[i] ^= a_k * (m[i - k] << k);
            }
        }
    }
    std::uint32_t sum = 0;
    for (std::uint32_t i = 1; i <= 32; ++i) {
        for (std::uint32_t digit = 1; digit <= i; ++digit) { // m_i / 2^i has its j-th digit at bit i - j of m_i
            if ((index >> (i - 1) & 1u) != 0 && (m[i] >> (i - digit) & 1u) != 0)
                sum ^= std::uint32_t{1} << (32 - digit);
        }
    }
    return sum;
}

/// Whether 2^m points from `first` on have one in each box of 2^-a by 2^-(m-a), for every a.
bool is_net(const SobolSequence& sequence, std::uint64_t first, std::uint32_t m) {
    const std::uint64_t size = std::uint64_t{1} << m;
    for (std::uint32_t a = 0; a <= m; ++a) {
        const double columns = std::ldexp(1.0, int(a)), rows = std::ldexp(1.0, int(m - a));
        std::vector<bool> taken(size);
        for (std::uint64_t i = first; i < first + size; ++i) {
            const auto column = static_cast<std::size_t>(sequence.sample<float>(i, 0) * columns);
            const auto row = static_cast<std::size_t>(sequence.sample<float>(i, 1) * rows);
            const std::size_t box = column * (std::size_t{1} << (m - a)) + row;
            if (taken[box])
                return false;
            taken[box] = true;
        }
    }
    return true;
}
} // namespace

TEST_CASE("SobolSequence: is a sequence") { tests::check_sequence_laws<SobolSequence>(20); }

// Joe and Kuo's notes list these for their generator, which goes through the indices in Gray code order.
TEST_CASE("sobol_bits: the first points are the published ones") {
    const double published[10][3] = {{0, 0, 0},
                                     {0.5, 0.5, 0.5},
                                     {0.75, 0.25, 0.25},
                                     {0.25, 0.75, 0.75},
                                     {0.375, 0.375, 0.625},
                                     {0.875, 0.875, 0.125},
                                     {0.625, 0.125, 0.875},
                                     {0.125, 0.625, 0.375},
                                     {0.1875, 0.3125, 0.9375},
                                     {0.6875, 0.8125, 0.4375}};
    for (std::uint32_t i = 0; i < 10; ++i) {
        for (std::uint32_t d = 0; d < 3; ++d)
            CHECK(std::ldexp(double(sobol_bits(i ^ (i >> 1), d)), -32) == published[i][d]);
    }
}

TEST_CASE("sobol_bits: agrees with the recurrence on integers, for all dimensions and index bits") {
    for (std::uint32_t d = 0; d < sobol_dimensions; ++d) {
        for (std::uint32_t k = 0; k < 300; ++k) {
            const std::uint32_t index =
                k < 32 ? std::uint32_t{1} << k : static_cast<std::uint32_t>(detail::mix_bits(k));
            CHECK(sobol_bits(index, d) == slow_sobol(index, d));
        }
    }
}

// Degree, coefficients, directions: the file's lines, without the dimension, apart from the library's table.
TEST_CASE("sobol_bits: the table is that of new-joe-kuo-6.21201") {
    std::istringstream file("1 0 1  2 1 1 3  3 1 1 3 1  3 2 1 1 1  4 1 1 1 3 3  4 4 1 3 5 13  5 2 1 1 5 5 17 "
                            "5 4 1 1 5 5 5  5 7 1 1 7 11 19  5 11 1 1 5 1 1  5 13 1 1 1 3 11  5 14 1 3 5 5 31 "
                            "6 1 1 3 3 9 7 49  6 13 1 1 1 15 21 21  6 16 1 3 1 13 27 49");
    for (const auto& d : detail::joe_kuo) {
        std::uint32_t degree = 0, coefficients = 0, direction = 0;
        file >> degree >> coefficients;
        CHECK(d.degree == degree);
        CHECK(d.coefficients == coefficients);
        for (std::uint32_t i = 0; i < degree; ++i) {
            file >> direction;
            CHECK(d.directions[i] == direction);
        }
    }
    CHECK(!file.fail());
}

TEST_CASE("sobol_bits: the polynomials are primitive and differ, the directions odd and in range") {
    std::vector<std::uint32_t> polynomials;
    for (const auto& d : detail::joe_kuo) {
        const std::uint32_t polynomial = 1u << d.degree | d.coefficients << 1 | 1u;
        polynomials.push_back(polynomial);
        // Primitive: x generates all 2^degree - 1 non-zero elements of the field before it comes back to 1.
        std::uint32_t element = 1, order = 0;
        do {
            element <<= 1;
            if ((element >> d.degree & 1u) != 0)
                element ^= polynomial;
            ++order;
        } while (element != 1 && order < 1000);
        CHECK(order == (1u << d.degree) - 1);
        for (std::uint32_t i = 0; i < d.degree; ++i) {
            CHECK(d.directions[i] % 2 == 1);
            CHECK(d.directions[i] < 2u << i);
        }
    }
    std::sort(polynomials.begin(), polynomials.end());
    CHECK(std::adjacent_find(polynomials.begin(), polynomials.end()) == polynomials.end());
}

// Sobol's property A, which Joe and Kuo's numbers have up to dimension 1111.
TEST_CASE("sobol_bits: the first 2^16 points lie one in each of the 2^16 half-side cubes of 16 dimensions") {
    std::vector<bool> taken(65536);
    for (std::uint32_t i = 0; i < 65536; ++i) {
        std::size_t cube = 0;
        for (std::uint32_t d = 0; d < 16; ++d)
            cube = cube << 1 | sobol_bits(i, d) >> 31;
        REQUIRE(!taken[cube]);
        taken[cube] = true;
    }
}

TEST_CASE("nested_uniform_scramble: a digit changes its own and later digits, and nothing before") {
    for (std::uint64_t k = 0; k < 200; ++k) {
        const auto digits = static_cast<std::uint32_t>(detail::mix_bits(k + 1));
        const std::uint64_t key = hash_bits(5, k);
        for (std::uint32_t bit = 0; bit < 32; ++bit) {
            const std::uint32_t flip = std::uint32_t{1} << bit;
            const std::uint32_t change =
                nested_uniform_scramble(digits, key) ^ nested_uniform_scramble(digits ^ flip, key);
            CHECK((change & (2 * flip - 1)) == flip);
        }
    }
}

// The sum over n keys of a product of two fair signs has standard deviation sqrt(n). There are 10922 pairs, so 6
// deviations: one failure in 50000 runs, were the keys drawn anew.
TEST_CASE("nested_uniform_scramble: whether a digit flips is a fair coin, another one for each prefix") {
    const std::size_t keys = 1024;
    const double bound = 6 * std::sqrt(double(keys));
    for (std::uint32_t level = 1; level <= 7; ++level) {
        const std::uint32_t prefixes = 1u << level;
        std::vector<std::vector<int>> flips(prefixes, std::vector<int>(keys));
        for (std::uint32_t p = 0; p < prefixes; ++p) {
            double sum = 0;
            for (std::size_t k = 0; k < keys; ++k) {
                flips[p][k] = (nested_uniform_scramble(p, hash_bits(1, k)) >> level & 1u) != 0 ? 1 : -1;
                sum += flips[p][k];
            }
            CHECK(std::abs(sum) < bound);
            for (std::uint32_t q = 0; q < p; ++q) {
                double product = 0;
                for (std::size_t k = 0; k < keys; ++k)
                    product += flips[p][k] * flips[q][k];
                CHECK(std::abs(product) < bound);
            }
        }
    }
}

TEST_CASE("SobolSequence: each aligned range of 2^m points has one in each dyadic interval of each dimension") {
    const SobolSequence sequence(3);
    for (std::uint32_t d = 0; d < SobolSequence::dimensions; ++d) {
        for (std::uint32_t m = 0; m <= 12; ++m) {
            const std::uint64_t size = std::uint64_t{1} << m;
            for (const std::uint64_t first : {std::uint64_t{0}, 5 * size, (std::uint64_t{7} << 32) + 6 * size}) {
                std::vector<bool> taken(size);
                for (std::uint64_t i = first; i < first + size; ++i)
                    taken[static_cast<std::size_t>(sequence.sample<float>(i, d) * float(size))] = true;
                CHECK(std::all_of(taken.begin(), taken.end(), [](bool b) { return b; }));
            }
        }
    }
}

TEST_CASE("SobolSequence: each aligned range of 2^m points has one in each dyadic box of the first two dimensions") {
    for (const std::uint64_t seed : {0u, 1u, 2u}) {
        const SobolSequence sequence(seed);
        for (std::uint32_t m = 0; m <= 10; ++m) {
            for (const std::uint64_t first : {std::uint64_t{0}, std::uint64_t{3} << m, std::uint64_t{1} << 40})
                CHECK(is_net(sequence, first, m));
        }
    }
}

TEST_CASE("SobolSequence: the points from index 2^32 on are scrambled by themselves") {
    const SobolSequence sequence(3);
    int same = 0;
    for (std::uint64_t i = 0; i < 1000; ++i) {
        same += sequence.sample<float>(i, 1) == sequence.sample<float>(i + (std::uint64_t{1} << 32), 1) ? 1 : 0;
        same += sequence.sample<float>(i, 1) == sequence.sample<float>(i + (std::uint64_t{1} << 33), 1) ? 1 : 0;
    }
    CHECK(same <= 2);
}

// For smooth integrands the error falls as n^-3/2 (times logarithms), for unscrambled points as 1 / n at best, for
// random ones as n^-1/2: by a factor of 64, 16 and 4 from 256 points to 4096.
TEST_CASE("SobolSequence: scrambling makes the error fall faster than the number of points grows") {
    const auto product_of_two = [](auto& sampler) {
        const double x = sampler.template next<double>();
        return std::exp(x) * (1 + sampler.template next<double>());
    };
    const double exact = (std::exp(1.0) - 1) * 1.5;
    const double few = tests::integration_error<SobolSequence>(product_of_two, exact, 256);
    const double many = tests::integration_error<SobolSequence>(product_of_two, exact, 4096);
    CHECK(few / many > 32);
}

TEST_CASE("SobolSequence: integrates in four dimensions with a twentieth of the error of random samples") {
    const double error = tests::integration_error<SobolSequence>(tests::product_of_four, 1, 4096);
    const double random = std::sqrt((std::pow(13.0 / 12, 4) - 1) / 4096);
    CHECK(error < random / 20);
}

} // namespace nephroid::tests::sobol_test
