// SPDX-License-Identifier: MIT
/// @file  The Sobol' sequence [Sobol' 1967] with hashed Owen scrambling [Laine and Karras 2011; Burley 2020].
#pragma once

#include "nephroid/sequence/hash.hpp"
#include "nephroid/sequence/random.hpp"
#include "nephroid/sequence/sequence.hpp"

#include <array>
#include <cassert>
#include <concepts>
#include <cstddef>
#include <cstdint>

namespace nephroid {

/// The number of tabulated dimensions of the Sobol' sequence.
inline constexpr std::uint32_t sobol_dimensions = 16;

namespace detail {

/// The definition of a dimension: the primitive polynomial's degree, its inner coefficients as bits, the first
/// directions.
struct SobolDimension {
    std::uint32_t degree;
    std::uint32_t coefficients;
    std::array<std::uint32_t, 6> directions;
};

/// Joe and Kuo 2008, "Constructing Sobol sequences with better two-dimensional projections", new-joe-kuo-6.21201.
/// Dimension 0 has no polynomial: it is the van der Corput sequence.
inline constexpr std::array<SobolDimension, sobol_dimensions - 1> joe_kuo = {{
    {1, 0, {1}},
    {2, 1, {1, 3}},
    {3, 1, {1, 3, 1}},
    {3, 2, {1, 1, 1}},
    {4, 1, {1, 1, 3, 3}},
    {4, 4, {1, 3, 5, 13}},
    {5, 2, {1, 1, 5, 5, 17}},
    {5, 4, {1, 1, 5, 5, 5}},
    {5, 7, {1, 1, 7, 11, 19}},
    {5, 11, {1, 1, 5, 1, 1}},
    {5, 13, {1, 1, 1, 3, 11}},
    {5, 14, {1, 3, 5, 5, 31}},
    {6, 1, {1, 3, 3, 9, 7, 49}},
    {6, 13, {1, 1, 1, 15, 21, 21}},
    {6, 16, {1, 3, 1, 13, 27, 49}},
}};

[[nodiscard]] constexpr std::uint32_t reverse_bits32(std::uint32_t x) noexcept {
    return static_cast<std::uint32_t>(reverse_bits(x) >> 32);
}

/// For each bit of the index the bits that it flips in the coordinate, whose first digit is the highest bit.
[[nodiscard]] constexpr std::array<std::uint32_t, 32> sobol_matrix(std::uint32_t dimension) noexcept {
    std::array<std::uint32_t, 32> columns{};
    if (dimension == 0) {
        for (std::size_t i = 0; i < 32; ++i)
            columns[i] = std::uint32_t{1} << (31 - i);
        return columns;
    }
    const SobolDimension& d = joe_kuo[dimension - 1];
    for (std::size_t i = 0; i < d.degree; ++i)
        columns[i] = d.directions[i] << (31 - i);
    for (std::size_t i = d.degree; i < 32; ++i) {
        columns[i] = columns[i - d.degree] ^ (columns[i - d.degree] >> d.degree);
        for (std::size_t k = 1; k < d.degree; ++k) {
            if ((d.coefficients >> (d.degree - 1 - k) & 1u) != 0)
                columns[i] ^= columns[i - k];
        }
    }
    return columns;
}

/// For each value of four bits of the index the bits that it flips in the coordinate, whose first digit here is the
/// *lowest* bit.
using SobolTable = std::array<std::array<std::uint32_t, 16>, 8>;

inline constexpr auto sobol_tables = [] {
    std::array<SobolTable, sobol_dimensions> tables{};
    for (std::uint32_t dimension = 0; dimension < sobol_dimensions; ++dimension) {
        const auto columns = sobol_matrix(dimension);
        for (std::size_t bit = 0; bit < 32; ++bit) {
            const std::uint32_t flips = reverse_bits32(columns[bit]);
            // A value with this highest bit flips these bits besides those that it flips without it. (Few steps, as
            // compilers are slow at each.)
            auto& table = tables[dimension][bit / 4];
            const std::size_t highest = std::size_t{1} << (bit % 4);
            for (std::size_t rest = 0; rest < highest; ++rest)
                table[highest + rest] = table[rest] ^ flips;
        }
    }
    return tables;
}();

/// The 32 binary digits of a coordinate, the first one in the lowest bit.
[[nodiscard]] constexpr std::uint32_t sobol_digits(std::uint32_t index, std::uint32_t dimension) noexcept {
    const SobolTable& t = sobol_tables[dimension];
    return t[0][index & 15u] ^ t[1][index >> 4 & 15u] ^ t[2][index >> 8 & 15u] ^ t[3][index >> 12 & 15u] ^
           t[4][index >> 16 & 15u] ^ t[5][index >> 20 & 15u] ^ t[6][index >> 24 & 15u] ^ t[7][index >> 28];
}
} // namespace detail

/// The unscrambled Sobol' point's coordinate in units of 2^-32.
///
/// @param dimension  below `sobol_dimensions`
[[nodiscard]] constexpr std::uint32_t sobol_bits(std::uint32_t index, std::uint32_t dimension) noexcept {
    assert(dimension < sobol_dimensions && "nephroid::sobol_bits: no such dimension is tabulated");
    return detail::reverse_bits32(detail::sobol_digits(index, dimension));
}

namespace detail {
/// Owen's nested uniform scrambling of 32 binary digits, the first one in the lowest bit: whether a digit flips is a
/// random function of the digits before it.
///
/// In every step a bit affects only itself and higher bits, which makes the scrambling nested [Laine and Karras 2011].
/// The flips of different prefixes are independent because the key enters three times, and by the choice of constants:
/// their correlations over keys cannot be told from an ideal scrambling's [include/nephroid/README.md, "Sequences"].
[[nodiscard]] constexpr std::uint32_t nested_uniform_scramble(std::uint32_t digits, std::uint64_t key) noexcept {
    const auto low = static_cast<std::uint32_t>(key), high = static_cast<std::uint32_t>(key >> 32);
    std::uint32_t x = digits;
    x ^= x * 0x9a82e0eeu; // an even factor: a bijection, as each bit is flipped by lower ones only
    x += low;
    x *= high | 1u;
    x ^= x * 0xbdc3a866u;
    x += high >> 16 | high << 16;
    x ^= x * 0x499ed6ceu;
    return x;
}
} // namespace detail

/// The Sobol' sequence, with each dimension scrambled by itself, at random among the scramblings that keep its
/// structure.
///
/// Any 2^m successive points from a multiple of 2^m on have exactly one in each dyadic interval of each dimension, and
/// in dimensions 0 and 1 together one in each dyadic box of area 2^-m, of any shape (a (0, 2)-sequence in base 2). Each
/// scrambled point is uniform in the cube, so averages over seeds are unbiased, and for smooth integrands the error is
/// smaller by another factor sqrt(N) than with the unscrambled sequence [Owen 1997]. Every seed scrambles, 0 too; for
/// the plain points see `sobol_bits`.
///
/// Coordinates are multiples of 2^-32 (float: 2^-24). Each 2^32 successive indices fill that grid; the next 2^32 are
/// the same points with another scrambling: stratified among themselves, independent of the others. From dimension
/// `dimensions` on, numbers are hashed as in RandomSequence. Any index.
///
/// Source: Burley 2020, "Practical hash-based Owen scrambling"; Sobol' 1967; Joe and Kuo 2008 for the directions.
class SobolSequence {
public:
    static constexpr bool stratified = true;
    static constexpr std::uint32_t dimensions = sobol_dimensions;

    explicit constexpr SobolSequence(std::uint64_t seed = 0) noexcept : beyond_(seed) {
        for (std::uint32_t d = 0; d < dimensions; ++d)
            keys_[d] = hash_bits(seed, d);
    }

    /// The coordinate of a point, in [0, 1).
    template <std::floating_point T>
    [[nodiscard]] constexpr T sample(std::uint64_t index, std::uint32_t dimension) const noexcept {
        if (dimension >= dimensions)
            return beyond_.sample<T>(index, dimension);

        const auto low = static_cast<std::uint32_t>(index), high = static_cast<std::uint32_t>(index >> 32);
        const std::uint64_t key = high == 0 ? keys_[dimension] : hash_bits(keys_[dimension], high);
        const std::uint32_t digits = detail::nested_uniform_scramble(detail::sobol_digits(low, dimension), key);
        return uniform_from_bits<T>(detail::reverse_bits32(digits));
    }

private:
    std::array<std::uint64_t, dimensions> keys_{};
    RandomSequence beyond_;
};

static_assert(SampleSequence<SobolSequence>);
} // namespace nephroid
