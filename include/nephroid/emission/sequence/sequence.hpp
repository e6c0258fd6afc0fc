// SPDX-License-Identifier: MIT
/// @file  What a sequence of sample points is, and the stream of numbers that one photon draws from it.
#pragma once

#include <concepts>
#include <cstdint>
#include <type_traits>

namespace nephroid {

template <class S, class T>
concept SamplesAs = requires(const S sequence, std::uint64_t index, std::uint32_t dimension) {
    { sequence.template sample<T>(index, dimension) } -> std::same_as<T>;
};

template <class S>
concept SaysWhetherStratified = requires {
    typename std::bool_constant<S::stratified>; // known to the compiler
};

/// An infinite sequence of points in the unit cube of any dimension, each coordinate to be had on its own.
///
/// `sample<T>(index, dimension)` is the coordinate of a point: in [0, 1), never 1, and a pure function of the
/// sequence's seed and its two arguments, for every index and dimension, so that any range of points can be taken
/// anywhere, in any order. `stratified` says whether the points of a range avoid each other: footprints of photons
/// from a stratified sequence tile what random ones only cover on average.
///
/// The compiler checks the call; `tests/emission/sequence/sequence_laws.hpp` checks the meaning, for every model.
template <class S>
concept SampleSequence =
    std::copy_constructible<S> && SamplesAs<S, float> && SamplesAs<S, double> && SaysWhetherStratified<S>;

/// The numbers that one photon draws, in the order in which it draws them: the coordinates of the point with its
/// index, from `first_dimension` on. A pure function of the sequence's seed, the index, and how many were drawn.
///
/// Cheap to copy: it refers to the sequence, which has to outlive it.
template <SampleSequence Sequence>
class Sampler {
public:
    explicit constexpr Sampler(const Sequence& sequence, std::uint64_t index,
                               std::uint32_t first_dimension = 0) noexcept
        : sequence_(&sequence), index_(index), dimension_(first_dimension) {}
    explicit Sampler(const Sequence&&, std::uint64_t, std::uint32_t = 0) = delete; // would refer to a temporary

    /// The next number, in [0, 1).
    template <std::floating_point T>
    [[nodiscard]] constexpr T next() {
        return sequence_->template sample<T>(index_, dimension_++);
    }

    /// Which point of the sequence this is: the photon's number.
    [[nodiscard]] constexpr std::uint64_t index() const noexcept { return index_; }
    /// The dimension from which the next number comes.
    [[nodiscard]] constexpr std::uint32_t dimension() const noexcept { return dimension_; }

private:
    const Sequence* sequence_;
    std::uint64_t index_;
    std::uint32_t dimension_;
};
} // namespace nephroid
