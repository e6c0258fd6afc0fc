// SPDX-License-Identifier: MIT
/// @file  Checks a map that was fitted to tangents against the places where photons landed.
///
/// Tangents do not show jumps: on a flat facet of a mesh they hardly change, yet across its edge the light goes
/// elsewhere. Places show them. If places contradict the map in many cells, no footprint is chosen from it. Tangents
/// that scatter about the fit are no contradiction, because footprints are chosen smaller there already
/// [include/nephroid/README.md, "Footprints from neighbours"].
#pragma once

#include "nephroid/smoothing/second_order/path_derivatives.hpp"
#include "nephroid/vector/scalar.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace nephroid::detail {

/// Where the photons around a point of the emission domain landed.
class Landings {
public:
    /// @param at        displacement of the photon from the point, in the frame of the fit
    /// @param tangents  its own, by the axes of that frame
    /// @param weight    > 0
    void add(Plane2 at, const Double3& place, const std::array<Double3, 2>& tangents, double weight) {
        landings_.push_back({at, place, tangents, weight});
    }

    /// Whether the photons landed elsewhere than the map says.
    ///
    /// The map is first moved so that it fits the landing points on average. The points contradict it if they still
    /// miss it by more than a part of the distances that it predicts, and by more than twice what the scatter of the
    /// tangents explains. The distances come from the tangents' lengths, not from the landing points, because at a fold
    /// some steps in the domain do not move the landing point.
    ///
    /// @param map           derivatives at the point, fitted to tangents
    /// @param largest_part  of the root mean square distance, >= 0
    [[nodiscard]] bool contradict(const PathDerivatives& map, double largest_part) const {
        Double3 sum{};
        double weights = 0, largest = 0;
        for (const Landing& landing : landings_) {
            const Double3& p = landing.place;
            sum += landing.weight * (p - displacement_by(map, landing.at));
            weights += landing.weight;
            largest = (std::max)({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        }
        if (!(weights > 0) || !std::isfinite(largest_part))
            return false;
        const Double3 middle = (1 / weights) * sum;
        const double stretch2 = 0.5 * (inner(map.first[0], map.first[0]) + inner(map.first[1], map.first[1]));
        constexpr double rounding = 2e-6;          // of a place, if the renderer's scalar is a float
        double missed = 0, steps = 0, scatter = 0; // squared
        for (const Landing& landing : landings_) {
            const Double3 miss = landing.place - displacement_by(map, landing.at) - middle;
            missed += landing.weight * inner(miss, miss);
            steps += landing.weight * inner(landing.at, landing.at);
            const auto fitted = tangents_at(map, landing.at);
            for (std::size_t i = 0; i < 2; ++i) {
                const Double3 off = landing.tangents[i] - fitted[i];
                scatter += 0.5 * landing.weight * inner(off, off);
            }
        }
        const double expected = (std::max)(square(largest_part) * stretch2, 4 * scatter / weights) * steps;
        return !(missed <= expected + weights * square(rounding * largest));
    }

private:
    struct Landing {
        Plane2 at;
        Double3 place;
        std::array<Double3, 2> tangents;
        double weight;
    };
    std::vector<Landing> landings_;
};

} // namespace nephroid::detail
