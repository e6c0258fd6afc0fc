// SPDX-License-Identifier: MIT
/// @file  Single photons through tiny scenes, for the tests of the walk.
#pragma once

#include "transport/tiny_scenes.hpp"

#include <limits>
#include <optional>

namespace nephroid::tests {

template <class T>
constexpr double epsilon = double(std::numeric_limits<T>::epsilon());

template <class T>
constexpr T quiet_nan = std::numeric_limits<T>::quiet_NaN();

/// Walks one photon with a sampler that always draws the same.
template <class S, class V, class F, std::size_t N>
std::optional<Deposit<V, F, N>> follow(const S& scene, const Photon<V, F, N>& photon, Statistics& account,
                                       const WalkLimits& limits = {}, double draw = 0.5) {
    Constant sampler{draw};
    return walk(scene, photon, sampler, limits, account);
}

template <class T>
SheetScene<T> mirror_above_floor(T weight = T(1)) {
    // Light goes down onto the mirror z = 0 and back up to the ceiling z = 2.
    return {{{{0, 0, 0}, {0, 0, 1}, Event::reflect, weight}, {{0, 0, 2}, {0, 0, 1}, Event::deposit}}};
}

} // namespace nephroid::tests
