// SPDX-License-Identifier: MIT
/// @file  Second-order splatting beside first order, on one case and sequence after the other.
#pragma once

#include "common/study/smoothing/command.hpp"
#include "common/study/trial.hpp"

namespace nephroid::examples::study::smoothing {

/// The same photons splatted in three ways, by growing number of photons.
struct Case {
    std::string name;
    SequenceKind sequence;
    std::vector<Trial> best;   ///< first order, s found against the truth, for each measure anew
    std::vector<Trial> fixed;  ///< first order, one s for all numbers of photons
    std::vector<Trial> second; ///< second order, footprints chosen from the photons
};

/// Throws UsageError if the picture of one of the cases is not known and no reference is given.
void check_references(const Options& options);

/// @param done  called with each trial when it is finished
[[nodiscard]] std::vector<Case> measure_cases(const Options& options, const std::function<void(const Trial&)>& done);

/// The trials of one way, as the functions of equal.hpp take them.
[[nodiscard]] std::vector<const Trial*> pointers(const std::vector<Trial>& trials);

/// By how much the error of second order is larger than first order's at the best s with as many photons.
[[nodiscard]] double ratio(const Case& one, std::size_t count, Measure measure);

} // namespace nephroid::examples::study::smoothing
