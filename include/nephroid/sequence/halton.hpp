// SPDX-License-Identifier: MIT
/// @file  The Halton sequence [Halton 1960] with Faure's permutations of the digits [Faure 1992].
#pragma once

#include "nephroid/sequence/hash.hpp"
#include "nephroid/sequence/random.hpp"
#include "nephroid/sequence/sequence.hpp"

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace nephroid {

namespace detail {
/// Faure's permutation of the digits 0 to Base - 1. It keeps Base - 1 and 0, so the leading zeros of an index stay
/// zeros.
///
/// For base 2c: the permutation of base c doubled, then the same plus one. For base 2c + 1: the permutation of base 2c
/// with c inserted in its middle and the values from c on increased by one. So 0 1, 0 1 2, 0 2 1 3, 0 3 2 1 4,
/// 0 2 4 1 3 5, ...
/// Source: Faure 1992, "Good permutations for extreme discrepancy".
template <std::uint32_t Base>
    requires(Base >= 1)
[[nodiscard]] constexpr std::array<std::uint32_t, Base> faure_permutation() noexcept {
    std::array<std::uint32_t, Base> permutation{};
    if constexpr (Base > 1) {
        constexpr std::uint32_t half = Base / 2;
        if constexpr (Base % 2 == 0) {
            constexpr auto halved = faure_permutation<half>();
            for (std::size_t i = 0; i < half; ++i) {
                permutation[i] = 2 * halved[i];
                permutation[i + half] = 2 * halved[i] + 1;
            }
        } else {
            constexpr auto even = faure_permutation<Base - 1>();
            permutation[half] = half;
            for (std::size_t i = 0; i < Base - 1; ++i)
                permutation[i < half ? i : i + 1] = even[i] + (even[i] >= half ? 1 : 0);
        }
    }
    return permutation;
}

/// The size of a table that looks up several digits of an index at once: as many as fit into 3 KiB, at least two.
[[nodiscard]] constexpr std::uint32_t halton_block_size(std::uint32_t base) noexcept {
    std::uint32_t size = base * base;
    while (size * base <= 1500)
        size *= base;
    return size;
}

/// An array without member functions, because calls of them slow down the compiler when it fills a large table.
template <std::uint32_t Size>
struct HaltonTable {
    static constexpr std::uint32_t size = Size;
    std::uint16_t entries[Size];
};

/// For each block of digits its number with the digits permuted and in reverse order.
template <std::uint32_t Base>
inline constexpr auto halton_reversed_digits = [] {
    constexpr auto permutation = faure_permutation<Base>();
    constexpr std::uint32_t size = halton_block_size(Base);
    HaltonTable<size> reversed{};
    // An additional leading digit moves the others back by one, so the table grows from its own entries. It takes few
    // steps for each entry, because compilers need about a microsecond for each step. The part of digit 0 is written
    // last, because the other parts are computed from it.
    for (std::uint32_t known = 1; known < size; known *= Base) {
        for (std::uint32_t i = 0; i < known; ++i)
            reversed.entries[i] = static_cast<std::uint16_t>(reversed.entries[i] * Base);
        for (std::uint32_t digit = Base, end = known * Base; digit-- > 1; end -= known) {
            const std::uint32_t front = permutation[digit];
            for (std::uint32_t i = 0, to = end - known; i < known; ++i, ++to)
                reversed.entries[to] = static_cast<std::uint16_t>(reversed.entries[i] + front);
        }
    }
    return reversed;
}();
/// The radical inverse with Faure's permutation: the digits of the index in an integer base, permuted, in reverse order
/// behind the point.
///
/// For indices below 2^42 it is the nearest floating-point number, as one division of exact integers gives it; beyond,
/// digits below 2^-52 are dropped, which costs a few units in the last place. In base 2 it is cut off, not rounded. It
/// is never 1: a value that would round to 1 becomes the number before it.
template <std::floating_point T, std::uint32_t Base>
    requires(Base >= 2 && Base <= 53)
[[nodiscard]] constexpr T faure_radical_inverse(std::uint64_t index) noexcept {
    if constexpr (Base == 2) {
        return uniform_from_bits<T>(reverse_bits(index));
    } else {
        constexpr auto& reversed_digits = halton_reversed_digits<Base>;
        constexpr std::uint64_t block = reversed_digits.size;
        constexpr std::uint64_t last = std::uint64_t((std::numeric_limits<std::int64_t>::max)()) / block;

        std::uint64_t numerator = 0, denominator = 1;
        for (; index != 0 && denominator <= last; index /= block, denominator *= block)
            numerator = numerator * block + reversed_digits.entries[index % block];
        const double value = static_cast<double>(static_cast<std::int64_t>(numerator)) /
                             static_cast<double>(static_cast<std::int64_t>(denominator));
        constexpr T below_one = T(1) - std::numeric_limits<T>::epsilon() / 2;
        return (std::min)(static_cast<T>(value), below_one);
    }
}

} // namespace detail

/// The Halton sequence: the coordinate of point i in dimension d is the permuted radical inverse of i in the d-th prime
/// base.
///
/// With b the base of a dimension, any b^m successive points have one in each interval [k / b^m, (k + 1) / b^m); as
/// many successive points as a product of powers of several bases have one in each box of that grid. So every range of
/// indices is stratified, by itself and together with its neighbours.
///
/// The seed chooses the index at which each dimension starts: 0 for seed 0, the plain sequence; for any other seed a
/// random one below 2^32 [Wang and Hickernell 2000, "Randomized Halton sequences"]. By the Chinese remainder theorem
/// this is, to any finite resolution, a later range of the plain sequence, so it keeps all intervals and boxes, unlike
/// a random shift modulo 1. Over seeds each point is uniform in the cube to within 1e-7.
///
/// From dimension `dimensions` on, numbers are hashed as in RandomSequence. Indices must be below 2^63.
class HaltonSequence {
public:
    static constexpr bool stratified = true;
    /// The bases are the primes from 2 to 53.
    static constexpr std::uint32_t dimensions = 16;

    explicit constexpr HaltonSequence(std::uint64_t seed = 0) noexcept : beyond_(seed) {
        for (std::uint32_t d = 0; d < dimensions && seed != 0; ++d)
            starts_[d] = static_cast<std::uint32_t>(hash_bits(seed, d) >> 32);
    }

    /// The coordinate of a point, in [0, 1).
    template <std::floating_point T>
    [[nodiscard]] constexpr T sample(std::uint64_t index, std::uint32_t dimension) const noexcept {
        if (dimension >= dimensions)
            return beyond_.sample<T>(index, dimension);

        const std::uint64_t i = index + starts_[dimension];
        switch (dimension) { // the bases as constants: a division by a constant is a multiplication
        case 0:
            return detail::faure_radical_inverse<T, 2>(i);
        case 1:
            return detail::faure_radical_inverse<T, 3>(i);
        case 2:
            return detail::faure_radical_inverse<T, 5>(i);
        case 3:
            return detail::faure_radical_inverse<T, 7>(i);
        case 4:
            return detail::faure_radical_inverse<T, 11>(i);
        case 5:
            return detail::faure_radical_inverse<T, 13>(i);
        case 6:
            return detail::faure_radical_inverse<T, 17>(i);
        case 7:
            return detail::faure_radical_inverse<T, 19>(i);
        case 8:
            return detail::faure_radical_inverse<T, 23>(i);
        case 9:
            return detail::faure_radical_inverse<T, 29>(i);
        case 10:
            return detail::faure_radical_inverse<T, 31>(i);
        case 11:
            return detail::faure_radical_inverse<T, 37>(i);
        case 12:
            return detail::faure_radical_inverse<T, 41>(i);
        case 13:
            return detail::faure_radical_inverse<T, 43>(i);
        case 14:
            return detail::faure_radical_inverse<T, 47>(i);
        default:
            return detail::faure_radical_inverse<T, 53>(i);
        }
    }

private:
    std::array<std::uint32_t, dimensions> starts_{};
    RandomSequence beyond_;
};

static_assert(SampleSequence<HaltonSequence>);
} // namespace nephroid
