// SPDX-License-Identifier: MIT
/// @file  The concept of a sequence of sample points, and the sampler that draws one photon's numbers from it.
#pragma once

#include "nephroid/vector/scalar.hpp"

#include <concepts>
#include <cstdint>
#include <type_traits>

namespace nephroid {

namespace detail {
template <class S, class T>
concept SamplesAs = requires(const S sequence, std::uint64_t index, std::uint32_t dimension) {
    { sequence.template sample<T>(index, dimension) } -> std::same_as<T>;
};

template <class S>
concept HasStratifiedFlag = requires {
    typename std::bool_constant<S::stratified>; // a constant expression
};
} // namespace detail

/// An infinite sequence of points in the unit cube of any dimension, with random access to each coordinate.
///
/// `sample<T>(index, dimension)` is one coordinate of a point: in [0, 1), never 1, and a pure function of the
/// sequence's seed and the two arguments, for every index and dimension. So any machine can take any range of points,
/// in any order.
/// `stratified` says whether the points of a range avoid each other: footprints of photons from a stratified sequence
/// tile the area that those of random photons only cover on average.
///
/// ```cpp
/// struct MySequence {
///     static constexpr bool stratified = true;
///     template <std::floating_point T>
///     T sample(std::uint64_t index, std::uint32_t dimension) const { return my_sampler(index, dimension); }
/// };
/// ```
///
/// The compiler checks the call; `tests/sequence/sequence_laws.hpp` checks the meaning, for every model.
template <class S>
concept SampleSequence = std::copy_constructible<S> && detail::SamplesAs<S, float> && detail::SamplesAs<S, double> &&
    detail::HasStratifiedFlag<S>;

namespace detail {
template <class S>
consteval bool explain_sequence() {
    static_assert(SamplesAs<S, float> && SamplesAs<S, double>,
                  "nephroid: the sequence lacks sample<T>(index, dimension) const -> T for float and double "
                  "(sequence/sequence.hpp)");
    static_assert(HasStratifiedFlag<S>, "nephroid: the sequence lacks `static constexpr bool stratified` "
                                        "(sequence/sequence.hpp)");
    static_assert(std::copy_constructible<S>, "nephroid: the sequence cannot be copied");
    return false;
}

template <class S>
concept MustBeSequence = SampleSequence<S> || explain_sequence<S>();
} // namespace detail

/// Gives one photon its numbers: the coordinates of the point with the photon's index, one after another from
/// `first_dimension` on. They depend on the sequence's seed, the index and how many were drawn, and on nothing else.
///
/// Cheap to copy: it refers to the sequence, which must outlive it.
template <SampleSequence Sequence>
class Sampler {
public:
    explicit constexpr Sampler(const Sequence& sequence, std::uint64_t index,
                               std::uint32_t first_dimension = 0) noexcept
        : sequence_(&sequence), index_(index), dimension_(first_dimension) {}
    explicit Sampler(const Sequence&&, std::uint64_t, std::uint32_t = 0) = delete; // would refer to a temporary

    /// Draws the next number, in [0, 1). For a scalar that is a class (a dual number) it is drawn as a double.
    template <Scalar T>
    [[nodiscard]] constexpr T next() {
        if constexpr (std::floating_point<T>)
            return sequence_->template sample<T>(index_, dimension_++);
        else
            return T(sequence_->template sample<double>(index_, dimension_++));
    }

    /// The index of the point, and so of the photon.
    [[nodiscard]] constexpr std::uint64_t index() const noexcept { return index_; }
    /// The dimension of the next number.
    [[nodiscard]] constexpr std::uint32_t dimension() const noexcept { return dimension_; }

private:
    const Sequence* sequence_;
    std::uint64_t index_;
    std::uint32_t dimension_;
};
} // namespace nephroid
