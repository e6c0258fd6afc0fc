// SPDX-License-Identifier: MIT
/// @file  One method on some photons: its bandwidth swept, and measured and timed where it is best.
#pragma once

#include "common/errors.hpp"
#include "common/study/methods.hpp"
#include "common/study/options.hpp"
#include "common/study/sweep.hpp"

#include <functional>

namespace nephroid::examples::study {

/// Several runs of the same.
struct Timing {
    Seconds seconds;            ///< of the run with the median total
    double least = 0, most = 0; ///< totals
    unsigned repeats = 0;
    std::optional<double> memory; ///< bytes at the peak, beyond the eye path vertices and what the program holds anyway
};

/// A picture made from the lamp with a bandwidth that is best by some measure.
struct Best {
    const Method* method = nullptr; ///< in the setting that is best
    double bandwidth = 0;
    Errors errors;
    Timing timing;
    std::vector<float> irradiance; ///< the picture
};

/// The errors of a method in one of its settings.
struct Sweep {
    const Method* method = nullptr;
    std::map<double, Errors> errors; ///< by bandwidth
};

/// One method with the photons of one sequence and count.
struct Trial {
    const Method* method = nullptr;
    SequenceKind sequence{};
    std::uint64_t wanted = 0, caustic = 0, emitted = 0; ///< photons
    std::vector<Sweep> sweeps;                          ///< for each setting
    std::array<Best, measures.size()> best;             ///< by measure

    [[nodiscard]] const Best& by(Measure measure) const { return best[std::size_t(measure)]; }
    [[nodiscard]] double cost(Measure measure) const { return cost_of(by(measure).errors, measure); }
};

/// Sweeps a method's bandwidth with these photons and measures it at the best, by each measure.
/// @param photons  of the bench
[[nodiscard]] Trial tried(const Options& options, const Bench& bench, const Method& method, const Photons& photons);

/// The same at one bandwidth, not the best.
[[nodiscard]] Trial tried_at(const Bench& bench, const Method& method, const Photons& photons, double bandwidth);

/// Runs all that the options ask for: for each sequence and count the methods in turn, on the same photons.
/// @param done  called with each trial when it is finished; may take the pictures away
[[nodiscard]] std::vector<Trial> all_trials(const Options& options, const Bench& bench,
                                            const std::function<void(Trial&)>& done);

/// Those of one method and sequence, by growing number of photons.
[[nodiscard]] std::vector<const Trial*> trials_of(const std::vector<Trial>& trials, const std::string& method,
                                                  SequenceKind sequence);

/// The count at which methods are shown side by side, and that rivals have to match: 20,000, or else the smallest.
[[nodiscard]] std::uint64_t target_photons(const Options& options);

/// An error with four digits behind the point; a dash if it is not defined.
[[nodiscard]] std::string error_text(double value);

/// "0.123 s", with three digits that tell.
[[nodiscard]] std::string seconds_text(double seconds);

/// One line on what a trial came to.
[[nodiscard]] std::string summary(const Trial& trial);

} // namespace nephroid::examples::study
