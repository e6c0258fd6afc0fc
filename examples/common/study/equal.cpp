// SPDX-License-Identifier: MIT
#include "common/study/equal.hpp"

#include <cmath>

namespace nephroid::examples::study {

namespace {

/// From a to b > 0 in logarithms.
[[nodiscard]] double between(double a, double b, double t) { return a * std::pow(b / a, t); }

/// Where `value` lies between a and b, 0 to 1, in logarithms.
[[nodiscard]] double share(double a, double b, double value) {
    return a == b ? 1 : std::log(value / a) / std::log(b / a);
}

[[nodiscard]] double seconds_of(const Trial& trial, Measure measure) {
    return trial.by(measure).timing.seconds.total();
}

} // namespace

Effort effort_for(const std::vector<const Trial*>& trials, Measure measure, double target) {
    const Trial& first = *trials.front();
    if (first.cost(measure) <= target)
        return {Bound::at_most, double(first.wanted), seconds_of(first, measure)};
    for (std::size_t i = 1; i < trials.size(); ++i) {
        const Trial &a = *trials[i - 1], &b = *trials[i];
        if (b.cost(measure) > target)
            continue;
        const double t = share(a.cost(measure), b.cost(measure), target);
        return {Bound::within, between(double(a.wanted), double(b.wanted), t),
                between(seconds_of(a, measure), seconds_of(b, measure), t)};
    }
    return {Bound::more_than, double(trials.back()->wanted), seconds_of(*trials.back(), measure)};
}

Reached reached_after(const std::vector<const Trial*>& trials, Measure measure, double seconds) {
    if (seconds < seconds_of(*trials.front(), measure))
        return {Bound::more_than, trials.front()->cost(measure)};
    for (std::size_t i = 1; i < trials.size(); ++i) {
        const Trial &a = *trials[i - 1], &b = *trials[i];
        if (seconds_of(b, measure) < seconds)
            continue;
        const double t = share(seconds_of(a, measure), seconds_of(b, measure), seconds);
        return {Bound::within, between(a.cost(measure), b.cost(measure), t)};
    }
    return {Bound::at_most, trials.back()->cost(measure)};
}

std::optional<double> slope_of(const std::vector<const Trial*>& trials, Measure measure) {
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (const Trial* trial : trials) {
        const double cost = trial->cost(measure);
        if (!std::isfinite(cost) || !(cost > 0))
            continue;
        const double a = std::log(double(trial->wanted)), b = std::log(cost);
        n += 1, x += a, y += b, xx += a * a, xy += a * b;
    }
    if (n < 2)
        return std::nullopt;
    return (n * xy - x * y) / (n * xx - x * x);
}

} // namespace nephroid::examples::study
