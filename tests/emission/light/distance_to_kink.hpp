// SPDX-License-Identifier: MIT
/// @file  How far a point of a domain is from the lines across which a lamp's map to rays bends.
#pragma once

#include "nephroid/emission/domain.hpp"

#include <cmath>
#include <limits>

namespace nephroid::tests {

/// The distance of a point of a pair's unit square from the nearest kink; infinite if there is no kink, and 0 if the
/// kinks are unknown.
[[nodiscard]] inline double distance_to_kink(Kinks kinks, double u, double v) {
    const double a = std::abs(u - 0.5), b = std::abs(v - 0.5), root_half = std::sqrt(0.5);
    switch (kinks) {
    case Kinks::nowhere:
        return std::numeric_limits<double>::infinity();
    case Kinks::diagonals:
        return root_half * std::abs(a - b);
    case Kinks::unknown:
        break;
    }
    return 0;
}

} // namespace nephroid::tests
