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

/// The R2 sequence: the first two coordinates of point i are frac(½ + (i + 1)/ρ) and frac(½ + (i + 1)/ρ²),
/// ρ being the root of ρ³ = ρ + 1. Both steps are hard to approximate by fractions of one denominator, so that
/// successive points keep their distance: any n of them are at least 0.49/√n apart on the torus. Those of
/// HaltonSequence may be nearer.
///
/// Four more coordinates have steps of their own. Any n points are at least 0.42/∛n apart in the space of the first
/// two coordinates and any one of these. So those photons that such a number selects, the reflected ones say, keep
/// their distance too. The other coordinates are those of HaltonSequence. Indices must be below 2^63.
///
/// The seed moves the points: by ½ in every direction for seed 0, otherwise by random numbers. Points so moved keep
/// their distances, and over seeds each is uniform.
///
/// Source: Roberts 2018, "The unreasonable effectiveness of quasirandom sequences"; ρ is the plastic number. The four
/// steps are ours: the best of twelve million random ones for n up to 2^24, the later ones also in pairs.
class R2Sequence {
public:
    static constexpr bool stratified = true;

    explicit constexpr R2Sequence(std::uint64_t seed = 0) noexcept : beyond_(seed) {
        for (std::uint32_t d = 0; d < start_.size(); ++d)
            start_[d] = seed == 0 ? std::uint64_t{1} << 63 : hash_bits(seed, HaltonSequence::dimensions + d);
    }

    /// The coordinate of a point, in [0, 1).
    template <std::floating_point T>
    [[nodiscard]] constexpr T sample(std::uint64_t index, std::uint32_t dimension) const noexcept {
        if (dimension >= step_.size())
            return beyond_.sample<T>(index, dimension);
        // Whole turns overflow and are forgotten, so that the fraction is as exact for late points as for early ones.
        return uniform_from_bits<T>(start_[dimension] + (index + 1) * step_[dimension]);
    }

private:
    /// What a coordinate gains from point to point, in parts of 2^64: 1/ρ, 1/ρ², and the four.
    static constexpr std::array<std::uint64_t, 6> step_ = {0xc13fa9a902a6328f, 0x91e10da5c79e7b1d, 0x5d00d856983a9b25,
                                                           0x8707f40b06150657, 0xe2f860ff086876f1, 0x9e0be1a02777401f};
    std::array<std::uint64_t, step_.size()> start_{};
    HaltonSequence beyond_;
};

static_assert(SampleSequence<R2Sequence>);
} // namespace nephroid
