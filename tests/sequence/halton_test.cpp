// SPDX-License-Identifier: MIT
#include "nephroid/sequence/halton.hpp"

#include "sequence/sequence_laws.hpp"

#include "nephroid/sequence/random.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace nephroid::tests::halton_test {

using detail::faure_permutation;

namespace {

constexpr std::array<std::uint32_t, HaltonSequence::dimensions> primes = {2,  3,  5,  7,  11, 13, 17, 19,
                                                                          23, 29, 31, 37, 41, 43, 47, 53};

/// Faure's permutation by plain recursion at run time, written from the paper's words, apart from the library.
std::vector<std::uint32_t> slow_faure(std::uint32_t base) {
    if (base == 1)
        return {0};
    std::vector<std::uint32_t> result;
    if (base % 2 == 0) {
        const auto half = slow_faure(base / 2);
        for (const std::uint32_t x : half)
            result.push_back(2 * x);
        for (const std::uint32_t x : half)
            result.push_back(2 * x + 1);
        return result;
    }
    const std::uint32_t middle = base / 2;
    for (const std::uint32_t x : slow_faure(base - 1))
        result.push_back(x < middle ? x : x + 1);
    result.insert(result.begin() + middle, middle);
    return result;
}

/// The permuted digits behind the point, as a fraction of integers: exact while the denominator is below 2^53.
double slow_radical_inverse(std::uint64_t index, std::uint32_t base) {
    const auto permutation = slow_faure(base);
    std::uint64_t numerator = 0, denominator = 1;
    for (; index != 0; index /= base, denominator *= base)
        numerator = numerator * base + permutation[index % base];
    REQUIRE(denominator < std::uint64_t{1} << 53);
    return double(numerator) / double(denominator); // both exact, so the nearest double
}

/// The same from the last digit to the first, in floating point: for any index, to some roundings.
double rough_radical_inverse(std::uint64_t index, std::uint32_t base) {
    const auto permutation = slow_faure(base);
    std::vector<std::uint32_t> digits;
    for (; index != 0; index /= base)
        digits.push_back(permutation[index % base]);
    double value = 0;
    for (std::size_t i = digits.size(); i-- > 0;)
        value = (value + digits[i]) / base;
    return value;
}

/// Whether each of `size` points from `first` on lies in an interval of its own, of length 1 / size.
bool one_in_each_interval(const HaltonSequence& sequence, std::uint32_t dimension, std::uint64_t first,
                          std::uint64_t size) {
    std::vector<bool> taken(size);
    for (std::uint64_t i = first; i < first + size; ++i) {
        // A coordinate on an interval's lower end may be rounded to below it, by 2^-53. The number of digits sets the
        // next smaller distance from an end: above 1 / (53 * 2^33) of an interval, far more than 1e-12.
        const double x = sequence.sample<double>(i, dimension) * double(size) + 1e-12;
        const auto cell = static_cast<std::size_t>(x);
        if (cell >= size || taken[cell])
            return false;
        taken[cell] = true;
    }
    return true;
}

/// The largest difference, over boxes at the origin, between the share of points inside and the area: exact, by
/// trying every box that ends at the points' coordinates, open and closed.
template <class S>
double star_discrepancy(const S& sequence, std::uint64_t n) {
    std::vector<double> xs{1}, ys{1};
    for (std::uint64_t i = 0; i < n; ++i) {
        xs.push_back(sequence.template sample<double>(i, 0));
        ys.push_back(sequence.template sample<double>(i, 1));
    }
    double worst = 0;
    for (const double x : xs) {
        for (const double y : ys) {
            int open = 0, closed = 0;
            for (std::size_t i = 1; i < xs.size(); ++i) {
                open += xs[i] < x && ys[i] < y ? 1 : 0;
                closed += xs[i] <= x && ys[i] <= y ? 1 : 0;
            }
            worst = (std::max)({worst, x * y - open / double(n), closed / double(n) - x * y});
        }
    }
    return worst;
}

template <std::uint32_t Base>
void check_permutation() {
    const auto permutation = faure_permutation<Base>();
    const auto slow = slow_faure(Base);
    CHECK(std::equal(permutation.begin(), permutation.end(), slow.begin(), slow.end()));
    CHECK(permutation.front() == 0);
    CHECK(permutation.back() == Base - 1);
    auto sorted = permutation;
    std::sort(sorted.begin(), sorted.end());
    for (std::uint32_t i = 0; i < Base; ++i)
        CHECK(sorted[i] == i);
}
} // namespace

TEST_CASE("HaltonSequence: is a sequence") { tests::check_sequence_laws<HaltonSequence>(20); }

TEST_CASE("faure_permutation: the small ones are those that Faure published") {
    CHECK(faure_permutation<2>() == std::array<std::uint32_t, 2>{0, 1});
    CHECK(faure_permutation<3>() == std::array<std::uint32_t, 3>{0, 1, 2});
    CHECK(faure_permutation<4>() == std::array<std::uint32_t, 4>{0, 2, 1, 3});
    CHECK(faure_permutation<5>() == std::array<std::uint32_t, 5>{0, 3, 2, 1, 4});
    CHECK(faure_permutation<6>() == std::array<std::uint32_t, 6>{0, 2, 4, 1, 3, 5});
    CHECK(faure_permutation<7>() == std::array<std::uint32_t, 7>{0, 2, 5, 3, 1, 4, 6});
    CHECK(faure_permutation<8>() == std::array<std::uint32_t, 8>{0, 4, 2, 6, 1, 5, 3, 7});
}

TEST_CASE("faure_permutation: is a permutation that keeps the first and the last digit") {
    check_permutation<11>();
    check_permutation<13>();
    check_permutation<17>();
    check_permutation<29>();
    check_permutation<47>();
    check_permutation<53>();
    check_permutation<255>();
}

TEST_CASE("HaltonSequence: seed 0 is the digits permuted and reversed, to the last bit") {
    const HaltonSequence plain;
    for (std::uint32_t d = 0; d < HaltonSequence::dimensions; ++d) {
        for (const std::uint64_t first : {std::uint64_t{0}, std::uint64_t{16777200}, std::uint64_t{1} << 32,
                                          (std::uint64_t{1} << 40) + 12345, (std::uint64_t{1} << 42) - 2000}) {
            for (std::uint64_t i = first; i < first + 2000; ++i) {
                const double expected = slow_radical_inverse(i, primes[d]);
                REQUIRE(plain.sample<double>(i, d) == expected);
                // Base 2 is cut off to 24 bits, the others are rounded, but not to 1.
                const float rounded = (std::min)(static_cast<float>(expected), std::nextafter(1.0f, 0.0f));
                REQUIRE(std::abs(plain.sample<float>(i, d) - rounded) <= (d == 0 ? std::ldexp(1.0f, -24) : 0.0f));
            }
        }
    }
}

// n roundings of relative size 2^-53 in the slow way, 3 in the library's; dropped digits are worth below 2^-52.
TEST_CASE("HaltonSequence: large indices lose only digits below the last bit") {
    const HaltonSequence plain;
    const double tolerance = 8 * std::numeric_limits<double>::epsilon();
    for (std::uint32_t d = 0; d < HaltonSequence::dimensions; ++d) {
        for (int bits = 42; bits < 63; ++bits) {
            const std::uint64_t index = (std::uint64_t{1} << bits) + 0x123456789abu;
            CHECK(std::abs(plain.sample<double>(index, d) - rough_radical_inverse(index, primes[d])) <= tolerance);
        }
    }
}

// All digits the largest: 1 - b^-m, which float cannot tell from 1 once b^m > 2^25, double once b^m > 2^54.
TEST_CASE("HaltonSequence: the largest digits do not make a 1") {
    const HaltonSequence plain;
    for (std::uint32_t d = 0; d < HaltonSequence::dimensions; ++d) {
        std::uint64_t power = primes[d];
        while (power < std::uint64_t{1} << 57) {
            CHECK(plain.sample<float>(power - 1, d) < 1.0f);
            CHECK(plain.sample<double>(power - 1, d) < 1.0);
            CHECK(plain.sample<double>(power - 1, d) > 1 - 1.01 / double(power) - 1e-15);
            power *= primes[d];
        }
        CHECK(plain.sample<float>(power / primes[d] - 1, d) == std::nextafter(1.0f, 0.0f));
    }
}

TEST_CASE("HaltonSequence: each range of b^m points has one in each interval of length b^-m") {
    for (const std::uint64_t seed : {0u, 1u, 2u, 99u}) {
        const HaltonSequence sequence(seed);
        for (std::uint32_t d = 0; d < HaltonSequence::dimensions; ++d) {
            for (std::uint64_t size = primes[d]; size < 3000; size *= primes[d]) {
                for (const std::uint64_t first : {std::uint64_t{0}, size, std::uint64_t{17}, std::uint64_t{123457}})
                    CHECK(one_in_each_interval(sequence, d, first, size));
            }
        }
    }
}

TEST_CASE("HaltonSequence: each range of 2^a 3^b 5^c points has one in each box of that grid, for any seed") {
    for (const std::uint64_t seed : {0u, 1u, 2u, 99u}) {
        const HaltonSequence sequence(seed);
        for (const auto& [a, b, c] : {std::array{8u, 9u, 5u}, std::array{2u, 27u, 1u}, std::array{16u, 3u, 25u}}) {
            for (const std::uint64_t first : {0u, 1u, 54321u}) {
                std::vector<int> count(a * b * c);
                for (std::uint64_t i = first; i < first + a * b * c; ++i) {
                    const auto cell = [&](std::uint32_t d, std::uint32_t cells) { // 1e-12: as above
                        return static_cast<std::size_t>(sequence.sample<double>(i, d) * cells + 1e-12);
                    };
                    ++count[(cell(0, a) * b + cell(1, b)) * c + cell(2, c)];
                }
                CHECK(std::all_of(count.begin(), count.end(), [](int n) { return n == 1; }));
            }
        }
    }
}

TEST_CASE("HaltonSequence: with a seed each dimension starts at an index of its own") {
    const HaltonSequence plain;
    for (std::uint64_t seed = 1; seed < 20; ++seed) {
        const HaltonSequence sequence(seed);
        // In base 2 the first coordinate, its bits in reverse order, tells the start.
        const auto bits = static_cast<std::uint64_t>(std::ldexp(sequence.sample<double>(0, 0), 53));
        const std::uint64_t start = detail::reverse_bits(bits << 11);
        CHECK(start < std::uint64_t{1} << 32);
        CHECK(sequence.sample<double>(0, 0) == plain.sample<double>(start, 0));
        for (std::uint32_t d = 1; d < HaltonSequence::dimensions; ++d)
            CHECK(sequence.sample<double>(0, d) != plain.sample<double>(start, d));
    }
}

TEST_CASE("HaltonSequence: covers the square more evenly than random points do") {
    const std::uint64_t n = 144;
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
        // Halton's bound, ((b - 1) / (2 ln b) ln n + (b + 1) / 2) multiplied over the bases, by n, is 0.23: weak. Over
        // the first 100 seeds Halton has at most 0.033, random points at least 0.060.
        CHECK(star_discrepancy(HaltonSequence(seed), n) < 0.045);
        CHECK(star_discrepancy(RandomSequence(seed), n) > 0.05);
    }
}

TEST_CASE("HaltonSequence: integrates in four dimensions with a tenth of the error of random samples") {
    const double error = tests::integration_error<HaltonSequence>(tests::product_of_four, 1, 4096);
    const double random = std::sqrt((std::pow(13.0 / 12, 4) - 1) / 4096);
    CHECK(error < random / 10);
}

} // namespace nephroid::tests::halton_test
