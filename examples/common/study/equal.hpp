// SPDX-License-Identifier: MIT
/// @file  What a method needs for a given error, and what it reaches in a given time, between the counts measured.
#pragma once

#include "common/study/trial.hpp"

namespace nephroid::examples::study {

/// Whether a figure was reached between counts measured, already at the smallest, or not even at the largest.
enum class Bound { within, at_most, more_than };

/// Photons and seconds.
struct Effort {
    Bound bound;
    double photons, seconds;
};

/// What a method needs to bring a cost (`cost_of`) down to a target: on straight lines between the counts measured, in
/// logarithms of photons, seconds and cost. At the first count that reaches it, if costs do not fall steadily.
/// @param trials  of one method and sequence, by growing number of photons; not empty
[[nodiscard]] Effort effort_for(const std::vector<const Trial*>& trials, Measure measure, double target);

/// The cost that a method comes down to in so many seconds, on the same lines.
struct Reached {
    Bound bound; ///< more_than: the time is too short for the fewest photons measured; at_most: it is enough for more
                 ///< than the most of them
    double cost; ///< in these cases that of the fewest or the most photons
};
[[nodiscard]] Reached reached_after(const std::vector<const Trial*>& trials, Measure measure, double seconds);

/// The power p in cost ~ photons^p, by least squares in logarithms. Nothing for fewer than two counts.
[[nodiscard]] std::optional<double> slope_of(const std::vector<const Trial*>& trials, Measure measure);

} // namespace nephroid::examples::study
