// SPDX-License-Identifier: MIT
/// @file  The R2 sequence [Roberts 2018]: in two dimensions a lattice to which any number of points can be added.
#pragma once

#include "nephroid/sequence/halton.hpp"
#include "nephroid/sequence/hash.hpp"
#include "nephroid/sequence/sequence.hpp"

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>

namespace nephroid {

/// The R2 sequence: the first two coordinates of point i are frac(½ + (i + 1)/ρ) and frac(½ + (i + 1)/ρ²), ρ being the
/// root of ρ³ = ρ + 1. Both steps are hard to approximate by fractions of one denominator, so that successive points
/// keep their distance: any n of them are at least 0.49/√n apart on the torus. Those of HaltonSequence may be nearer.
///
/// The seed moves the lattice: by ½ in both directions for seed 0, otherwise by random numbers. Points so moved are
/// still a lattice, and over seeds each is uniform.
///
/// From the third on, coordinates are those of HaltonSequence from its first dimension on: as no multiple of a step of
/// the lattice is a whole number, they are stratified beside it. Indices must be below 2^63.
///
/// Source: Roberts 2018, "The unreasonable effectiveness of quasirandom sequences"; ρ is the plastic number.
class R2Sequence {
public:
    static constexpr bool stratified = true;

    explicit constexpr R2Sequence(std::uint64_t seed = 0) noexcept : beyond_(seed) {
        if (seed != 0)
            start_ = {hash_bits(seed, HaltonSequence::dimensions), hash_bits(seed, HaltonSequence::dimensions + 1)};
    }

    /// The coordinate of a point, in [0, 1).
    template <std::floating_point T>
    [[nodiscard]] constexpr T sample(std::uint64_t index, std::uint32_t dimension) const noexcept {
        if (dimension >= 2)
            return beyond_.sample<T>(index, dimension - 2);
        // Whole turns overflow and are forgotten, so that the fraction is as exact for late points as for early ones.
        return uniform_from_bits<T>(start_[dimension] + (index + 1) * step_[dimension]);
    }

private:
    /// 1/ρ and 1/ρ² of a turn, 2^64 being a whole one.
    static constexpr std::array<std::uint64_t, 2> step_ = {0xc13fa9a902a6328f, 0x91e10da5c79e7b1d};
    std::array<std::uint64_t, 2> start_ = {std::uint64_t{1} << 63, std::uint64_t{1} << 63};
    HaltonSequence beyond_;
};

static_assert(SampleSequence<R2Sequence>);
} // namespace nephroid
