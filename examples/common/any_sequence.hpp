// SPDX-License-Identifier: MIT
/// @file  The sample sequences that the programs' users choose from by name.
#pragma once

#include "common/command_line.hpp"

#include "nephroid/sequence/halton.hpp"
#include "nephroid/sequence/random.hpp"
#include "nephroid/sequence/sobol.hpp"

#include <variant>

namespace nephroid::examples {

enum class SequenceKind { halton, sobol, random };

[[nodiscard]] inline const Names<SequenceKind>& sequence_names() {
    static const Names<SequenceKind> names = {
        {"halton", SequenceKind::halton}, {"sobol", SequenceKind::sobol}, {"random", SequenceKind::random}};
    return names;
}

[[nodiscard]] inline const char* name_of(SequenceKind sequence) { return name_in(sequence_names(), sequence); }

using AnySequence = std::variant<HaltonSequence, SobolSequence, RandomSequence>;

[[nodiscard]] inline AnySequence make_sequence(SequenceKind sequence, std::uint64_t seed) {
    switch (sequence) {
    case SequenceKind::sobol:
        return SobolSequence(seed);
    case SequenceKind::random:
        return RandomSequence(seed);
    default:
        return HaltonSequence(seed);
    }
}

} // namespace nephroid::examples
