// SPDX-License-Identifier: MIT
#include "nephroid/sequence/halton.hpp"
#include "nephroid/sequence/random.hpp"
#include "nephroid/sequence/sequence.hpp"
#include "nephroid/sequence/sobol.hpp"

#include <doctest/doctest.h>

#include <concepts>
#include <cstdint>
#include <type_traits>

namespace nephroid::tests::sequence_test {

namespace {

/// A user's own: a lattice along the golden ratio, with another offset in each dimension.
struct GoldenSequence {
    static constexpr bool stratified = true;
    template <std::floating_point T>
    T sample(std::uint64_t index, std::uint32_t dimension) const {
        return uniform_from_bits<T>(0x9e3779b97f4a7c15u * (index + 1) + hash_bits(0, dimension));
    }
};

struct SaysNothing {
    template <std::floating_point T>
    T sample(std::uint64_t, std::uint32_t) const {
        return T(0);
    }
};

struct DoubleOnly {
    [[maybe_unused]] static constexpr bool stratified = false;
    template <class T>
    double sample(std::uint64_t, std::uint32_t) const {
        return 0;
    }
};

static_assert(SampleSequence<GoldenSequence>);
static_assert(!SampleSequence<int>);
static_assert(!SampleSequence<SaysNothing>);
static_assert(!SampleSequence<DoubleOnly>);
static_assert(!RandomSequence::stratified && HaltonSequence::stratified && SobolSequence::stratified);
static_assert(std::is_trivially_copyable_v<Sampler<HaltonSequence>>);
static_assert(!std::is_constructible_v<Sampler<HaltonSequence>, HaltonSequence, std::uint64_t>); // a temporary
} // namespace

TEST_CASE_TEMPLATE("Sampler: draws the coordinates of its point one after the other", S, RandomSequence, HaltonSequence,
                   SobolSequence) {
    const S sequence(9);
    Sampler<S> sampler(sequence, 1234);
    for (std::uint32_t d = 0; d < 40; ++d) {
        CHECK(sampler.dimension() == d);
        if (d % 2 == 0)
            CHECK(sampler.template next<float>() == sequence.template sample<float>(1234, d));
        else
            CHECK(sampler.template next<double>() == sequence.template sample<double>(1234, d));
    }
    CHECK(sampler.index() == 1234);
}

TEST_CASE("Sampler: starts at the dimension that it is told, and its copy goes on by itself") {
    const GoldenSequence sequence;
    Sampler<GoldenSequence> sampler(sequence, 3, 5);
    CHECK(sampler.next<float>() == sequence.sample<float>(3, 5));
    Sampler<GoldenSequence> copy = sampler;
    CHECK(copy.next<float>() == sequence.sample<float>(3, 6));
    CHECK(copy.next<float>() == sequence.sample<float>(3, 7));
    CHECK(sampler.next<float>() == sequence.sample<float>(3, 6));
}

} // namespace nephroid::tests::sequence_test
