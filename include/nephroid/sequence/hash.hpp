// SPDX-License-Identifier: MIT
/// @file  Mixes and reverses the bits of a 64-bit word, and turns them into a number in [0, 1).
#pragma once

#include "nephroid/vector/language.hpp"

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <limits>

namespace nephroid {

namespace detail {
/// Mixes 64 bits so that each bit of the result depends on each bit of x. A bijection; zero goes to zero.
///
/// Source: the finaliser of SplitMix64, Steele, Lea and Flood 2014, "Fast splittable pseudorandom number
/// generators", with Stafford's constants (his "Mix13").
[[nodiscard]] constexpr std::uint64_t mix_bits(std::uint64_t x) noexcept {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

/// The bits in reverse order.
[[nodiscard]] constexpr std::uint64_t reverse_bits(std::uint64_t x) noexcept {
    x = ((x >> 1) & 0x5555555555555555u) | ((x & 0x5555555555555555u) << 1);
    x = ((x >> 2) & 0x3333333333333333u) | ((x & 0x3333333333333333u) << 2);
    x = ((x >> 4) & 0x0f0f0f0f0f0f0f0fu) | ((x & 0x0f0f0f0f0f0f0f0fu) << 4);
    x = ((x >> 8) & 0x00ff00ff00ff00ffu) | ((x & 0x00ff00ff00ff00ffu) << 8);
    x = ((x >> 16) & 0x0000ffff0000ffffu) | ((x & 0x0000ffff0000ffffu) << 16);
    return (x >> 32) | (x << 32);
}
} // namespace detail

/// Makes a new seed from a seed and any value, zero included. For a fixed seed it is a bijection: different values
/// never give the same new seed. Nest calls to hash several values.
[[nodiscard]] constexpr std::uint64_t hash_bits(std::uint64_t seed, std::uint64_t value) noexcept {
    constexpr std::uint64_t golden_ratio = 0x9e3779b97f4a7c15u; // 2^64 / 1.618..., odd
    return detail::mix_bits(detail::mix_bits(seed + golden_ratio) + golden_ratio * (value + 1));
}

/// 32 random bits as a multiple of 2^-32 in [0, 1), for float of 2^-24: excess bits are cut off, not rounded, so the
/// result is never 1.
template <std::floating_point T>
[[nodiscard]] constexpr T uniform_from_bits(std::uint32_t bits) noexcept {
    constexpr int kept = (std::min)(32, std::numeric_limits<T>::digits);
    constexpr T unit = T(1) / static_cast<T>(std::uint64_t{1} << kept);
    return static_cast<T>(bits >> (32 - kept)) * unit;
}

/// 64 random bits as a multiple of 2^-53 in [0, 1), for float of 2^-24: never 1. A wider T also takes 53 bits.
template <std::floating_point T>
[[nodiscard]] constexpr T uniform_from_bits(std::uint64_t bits) noexcept {
    constexpr int kept = (std::min)(53, std::numeric_limits<T>::digits);
    constexpr T unit = T(1) / static_cast<T>(std::uint64_t{1} << kept);
    // By way of a signed integer: x86 converts unsigned ones only since AVX-512.
    return static_cast<T>(static_cast<std::int64_t>(bits >> (64 - kept))) * unit;
}
} // namespace nephroid
