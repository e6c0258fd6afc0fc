// SPDX-License-Identifier: MIT
#include "nephroid/sequence/hash.hpp"

#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace nephroid::tests::hash_test {

// The generator seeded with 0, whose state moves by the golden ratio, starts with these published numbers.
TEST_CASE("mix_bits: is the finaliser of SplitMix64") {
    const std::uint64_t golden = 0x9e3779b97f4a7c15u;
    CHECK(detail::mix_bits(golden) == 0xe220a8397b1dcdafu);
    CHECK(detail::mix_bits(2 * golden) == 0x6e789e6aa1b965f4u);
    CHECK(detail::mix_bits(3 * golden) == 0x06c45d188009454fu);
}

// Of 64 bits, each flips with probability 1/2: over n trials the count has standard deviation sqrt(n) / 2.
TEST_CASE("hash_bits: a flipped bit of the seed or of the value flips half of the bits") {
    const int trials = 2000;
    for (int flipped = 0; flipped < 64; ++flipped) {
        const std::uint64_t flip = std::uint64_t{1} << flipped;
        int by_seed = 0, by_value = 0;
        for (std::uint64_t i = 0; i < trials; ++i) {
            by_seed += std::popcount(hash_bits(i, 7) ^ hash_bits(i ^ flip, 7));
            by_value += std::popcount(hash_bits(7, i) ^ hash_bits(7, i ^ flip));
        }
        const double expected = 32.0 * trials, deviation = std::sqrt(64.0 * trials) / 2;
        CHECK(std::abs(by_seed - expected) < 5 * deviation);
        CHECK(std::abs(by_value - expected) < 5 * deviation);
    }
}

TEST_CASE("hash_bits: zero is as good as any other seed and value") {
    CHECK(hash_bits(0, 0) != 0);
    CHECK(hash_bits(0, 1) != hash_bits(1, 0));
    CHECK(hash_bits(0, ~std::uint64_t{0}) != 0); // there value + 1 wraps to 0
}

TEST_CASE("reverse_bits: bit i goes to bit 63 - i") {
    for (int i = 0; i < 64; ++i)
        CHECK(detail::reverse_bits(std::uint64_t{1} << i) == std::uint64_t{1} << (63 - i));
    CHECK(detail::reverse_bits(0x0123456789abcdefu) == 0xf7b3d591e6a2c480u);
}

TEST_CASE("uniform_from_bits: the most bits give the number before 1, no bits 0, half of them a half") {
    const auto all32 = std::numeric_limits<std::uint32_t>::max();
    const auto all64 = std::numeric_limits<std::uint64_t>::max();
    CHECK(uniform_from_bits<float>(all32) == std::nextafter(1.0f, 0.0f));
    CHECK(uniform_from_bits<float>(all64) == std::nextafter(1.0f, 0.0f));
    CHECK(uniform_from_bits<double>(all32) == 1 - std::ldexp(1.0, -32));
    CHECK(uniform_from_bits<double>(all64) == std::nextafter(1.0, 0.0));
    CHECK(uniform_from_bits<long double>(all64) < 1);

    CHECK(uniform_from_bits<float>(std::uint32_t{0}) == 0);
    CHECK(uniform_from_bits<double>(std::uint64_t{0}) == 0);
    CHECK(uniform_from_bits<float>(std::uint32_t{1} << 31) == 0.5f);
    CHECK(uniform_from_bits<double>(std::uint64_t{1} << 63) == 0.5);
    CHECK(uniform_from_bits<double>(std::uint64_t{1} << 11) == std::ldexp(1.0, -53)); // the last bit that is kept
    CHECK(uniform_from_bits<double>(std::uint32_t{1}) == std::ldexp(1.0, -32));
}

} // namespace nephroid::tests::hash_test
