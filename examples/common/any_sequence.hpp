// SPDX-License-Identifier: MIT
/// @file  The sample sequences that users of the programs choose by name.
#pragma once

#include "common/command_line.hpp"

#include "nephroid/sequence/halton.hpp"
#include "nephroid/sequence/random.hpp"
#include "nephroid/sequence/sobol.hpp"

#include <concepts>
#include <cstdint>
#include <variant>

namespace nephroid::examples {

enum class SequenceKind { halton, sobol, random };

[[nodiscard]] inline const Names<SequenceKind>& sequence_names() {
    static const Names<SequenceKind> names = {
        {"halton", SequenceKind::halton}, {"sobol", SequenceKind::sobol}, {"random", SequenceKind::random}};
    return names;
}

[[nodiscard]] inline const char* name_of(SequenceKind sequence) { return name_in(sequence_names(), sequence); }

/// Halton's or Sobol's sequence, chosen by a branch for each number, so that code that takes a sequence is compiled
/// once.
class StratifiedSequence {
public:
    static constexpr bool stratified = true;

    explicit StratifiedSequence(const HaltonSequence& halton = HaltonSequence()) : halton_(halton), is_halton_(true) {}
    explicit StratifiedSequence(const SobolSequence& sobol) : sobol_(sobol), is_halton_(false) {}

    template <std::floating_point T>
    [[nodiscard]] T sample(std::uint64_t index, std::uint32_t dimension) const noexcept {
        return is_halton_ ? halton_.sample<T>(index, dimension) : sobol_.sample<T>(index, dimension);
    }

private:
    HaltonSequence halton_;
    SobolSequence sobol_;
    bool is_halton_;
};

using AnySequence = std::variant<StratifiedSequence, RandomSequence>;

[[nodiscard]] inline AnySequence make_sequence(SequenceKind sequence, std::uint64_t seed) {
    switch (sequence) {
    case SequenceKind::sobol:
        return StratifiedSequence(SobolSequence(seed));
    case SequenceKind::random:
        return RandomSequence(seed);
    default:
        return StratifiedSequence(HaltonSequence(seed));
    }
}

} // namespace nephroid::examples
