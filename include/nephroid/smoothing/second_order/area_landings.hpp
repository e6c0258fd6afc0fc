// SPDX-License-Identifier: MIT
/// @file  Checks the map of an area light, fitted to tangents, against the places where photons landed.
///
/// As landings.hpp, but tangents say where photons land along the slice that footprints follow, and not across it.
/// Across it the places themselves are fitted, to second order.
#pragma once

#include "nephroid/smoothing/second_order/landings.hpp"
#include "nephroid/vector/least_squares.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace nephroid::detail {

/// Where the photons around a point of the domain landed. σ is a step along the slice, τ one across it.
class AreaLandings {
public:
    /// @param change  ∂J/∂τ times τ: how much the tangents change across the slice, on the way to the photon
    /// @param weight  > 0
    void add(const PathDerivatives& map, Plane2 sigma, Plane2 tau, const std::array<Space3, 2>& change,
             const Space3& place, double weight) {
        const Space3 by_tangents = displacement_by(map, sigma) + (sigma.x * change[0] + sigma.y * change[1]);
        landings_.push_back({{1, tau.x, tau.y, 0.5 * tau.x * tau.x, tau.x * tau.y, 0.5 * tau.y * tau.y},
                             place - by_tangents,
                             inner(sigma, sigma) + inner(tau, tau),
                             weight});
        across_.add(landings_.back().row, landings_.back().rest, weight);
        largest_ = (std::max)({largest_, std::abs(place.x), std::abs(place.y), std::abs(place.z)});
    }

    /// As Landings::contradict. Photons too few to fit the places across the slice contradict nothing.
    [[nodiscard]] bool contradict(const PathDerivatives& map, double largest_part) const {
        constexpr std::size_t linear = 3;
        std::array<Space3, unknowns> x{};
        if (!across_.solve(unknowns, x) && !across_.solve(linear, x))
            return false;
        const double stretch2 = 0.5 * (inner(map.first[0], map.first[0]) + inner(map.first[1], map.first[1]));
        double missed = 0, distances = 0, weights = 0; // the first two squared
        for (const Landing& landing : landings_) {
            Space3 miss = landing.rest;
            for (std::size_t k = 0; k < unknowns; ++k)
                miss += -landing.row[k] * x[k];
            missed += landing.weight * inner(miss, miss);
            distances += landing.weight * stretch2 * landing.distance2;
            weights += landing.weight;
        }
        return !(missed <= square(largest_part) * distances + weights * square(Landings::rounding * largest_));
    }

private:
    static constexpr std::size_t unknowns = 6;

    struct Landing {
        std::array<double, unknowns> row; ///< of the fit across the slice
        Space3 rest;                      ///< of the place, which the tangents do not explain
        double distance2, weight;
    };

    std::vector<Landing> landings_;
    LeastSquares<unknowns, Space3> across_;
    double largest_ = 0;
};

} // namespace nephroid::detail
