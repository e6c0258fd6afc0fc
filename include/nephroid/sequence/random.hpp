// SPDX-License-Identifier: MIT
/// @file  Independent uniform random numbers with random access, to compare other sequences with.
#pragma once

#include "nephroid/sequence/hash.hpp"
#include "nephroid/sequence/sequence.hpp"

#include <concepts>
#include <cstdint>

namespace nephroid {

/// Independent numbers: each is a hash of (seed, index, dimension). There is no state, so a photon's numbers do not
/// depend on the photons before it.
class RandomSequence {
public:
    static constexpr bool stratified = false;

    explicit constexpr RandomSequence(std::uint64_t seed = 0) noexcept
        : index_key_(hash_bits(seed, 0)), dimension_key_(hash_bits(seed, 1)) {}

    /// 64 random bits. Any index, any dimension.
    [[nodiscard]] constexpr std::uint64_t bits(std::uint64_t index, std::uint32_t dimension) const noexcept {
        // One key before each mixing: with a single key, the sequences of two seeds could be shifts of each other.
        constexpr std::uint64_t odd = 0xd1342543de82ef95u;
        return detail::mix_bits(detail::mix_bits(index + index_key_) + dimension_key_ + odd * dimension);
    }

    /// A number in [0, 1): multiples of 2^-53, for float of 2^-24.
    template <std::floating_point T>
    [[nodiscard]] constexpr T sample(std::uint64_t index, std::uint32_t dimension) const noexcept {
        return uniform_from_bits<T>(bits(index, dimension));
    }

private:
    std::uint64_t index_key_;
    std::uint64_t dimension_key_;
};

static_assert(SampleSequence<RandomSequence>);
} // namespace nephroid
