// SPDX-License-Identifier: MIT
/// @file  How wide an edge of known place has become: the distance over which the irradiance rises from 10% to 90%.
#pragma once

#include "nephroid/execution/executor.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace nephroid::examples::study::relax {

/// Where a pattern jumps, on the floor.
struct Edge {
    struct Place {
        std::array<double, 2> position;
        std::array<double, 2> inward; ///< unit, across the edge, to the brighter side
    };

    std::string name;
    double outside, inside; ///< irradiance on either side, outside < inside
    std::vector<Place> places;
};

/// Irradiance across an edge, the mean of its places.
struct EdgeProfile {
    double reach; ///< the first value is at -reach, outside, the last at reach
    std::vector<double> irradiance;

    [[nodiscard]] double step() const { return 2 * reach / static_cast<double>(irradiance.size() - 1); }
    [[nodiscard]] double offset(std::size_t i) const { return static_cast<double>(i) * step() - reach; }
};

/// @param reach       how far to look to either side
/// @param offsets     how many places along that, odd, >= 3
/// @param irradiance  irradiance(x, y), asked for at every place of the edge times the offsets, on several threads
template <class Irradiance, Executor E = SerialExecutor>
[[nodiscard]] EdgeProfile edge_profile(const Edge& edge, double reach, std::size_t offsets, Irradiance&& irradiance,
                                       E&& executor = E{}) {
    EdgeProfile profile{reach, std::vector<double>(offsets)};
    executor(offsets, [&](std::size_t i) {
        const double offset = profile.offset(i);
        double sum = 0;
        for (const auto& [position, inward] : edge.places)
            sum += irradiance(position[0] + offset * inward[0], position[1] + offset * inward[1]);
        profile.irradiance[i] = sum / static_cast<double>(edge.places.size());
    });
    return profile;
}

/// The distance over which the profile goes from 10% to 90% of the step between the edge's two sides: from the place
/// where it last was at 10% on the way from outside to where it first reaches 90% after that. A straight ramp of width
/// w has 0.8 w.
/// @return  NaN if the profile does not reach both
[[nodiscard]] inline double edge_width(const Edge& edge, const EdgeProfile& profile) {
    const auto share = [&](std::size_t i) {
        return (profile.irradiance[i] - edge.outside) / (edge.inside - edge.outside);
    };
    const auto crossing = [&](std::size_t i, double level) { // between i and i + 1
        return profile.offset(i) + profile.step() * (level - share(i)) / (share(i + 1) - share(i));
    };
    const std::size_t count = profile.irradiance.size();
    std::size_t high = 0;
    while (high < count && !(share(high) >= 0.9))
        ++high;
    std::size_t low = high;
    while (low > 0 && low < count && !(share(low) < 0.1))
        --low;
    if (high == count || high == 0 || !(share(low) < 0.1))
        return std::numeric_limits<double>::quiet_NaN();
    return crossing(high - 1, 0.9) - crossing(low, 0.1);
}

} // namespace nephroid::examples::study::relax
