// SPDX-License-Identifier: MIT
/// @file  The sample sequences that users of the programs choose by name.
#pragma once

#include "common/command_line.hpp"

#include "nephroid/sequence/halton.hpp"
#include "nephroid/sequence/r2.hpp"
#include "nephroid/sequence/random.hpp"
#include "nephroid/sequence/sobol.hpp"

#include <concepts>
#include <cstdint>
#include <variant>

namespace nephroid::examples {

enum class SequenceKind { halton, sobol, r2, random };

[[nodiscard]] inline const Names<SequenceKind>& sequence_names() {
    static const Names<SequenceKind> names = {{"halton", SequenceKind::halton},
                                              {"sobol", SequenceKind::sobol},
                                              {"r2", SequenceKind::r2},
                                              {"random", SequenceKind::random}};
    return names;
}

[[nodiscard]] inline const char* name_of(SequenceKind sequence) { return name_in(sequence_names(), sequence); }

/// A stratified sequence, chosen by a branch for each number, so that code that takes a sequence is compiled once.
class StratifiedSequence {
public:
    static constexpr bool stratified = true;

    explicit StratifiedSequence(SequenceKind kind = SequenceKind::halton, std::uint64_t seed = 0)
        : kind_(kind), halton_(seed), sobol_(seed), r2_(seed) {}

    template <std::floating_point T>
    [[nodiscard]] T sample(std::uint64_t index, std::uint32_t dimension) const noexcept {
        switch (kind_) {
        case SequenceKind::sobol:
            return sobol_.sample<T>(index, dimension);
        case SequenceKind::r2:
            return r2_.sample<T>(index, dimension);
        case SequenceKind::halton:
        case SequenceKind::random: // never chosen: `make_sequence` makes another class for it
            break;
        }
        return halton_.sample<T>(index, dimension);
    }

private:
    SequenceKind kind_;
    HaltonSequence halton_;
    SobolSequence sobol_;
    R2Sequence r2_;
};

using AnySequence = std::variant<StratifiedSequence, RandomSequence>;

[[nodiscard]] inline AnySequence make_sequence(SequenceKind sequence, std::uint64_t seed) {
    if (sequence == SequenceKind::random)
        return RandomSequence(seed);
    return StratifiedSequence(sequence, seed);
}

} // namespace nephroid::examples
