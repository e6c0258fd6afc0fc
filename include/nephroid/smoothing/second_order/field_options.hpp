// SPDX-License-Identifier: MIT
/// @file  The options of a field of footprints, and the field's value for one photon.
#pragma once

#include "nephroid/smoothing/second_order/path_derivatives.hpp"
#include "nephroid/smoothing/second_order/policies.hpp"
#include "nephroid/vector/plane.hpp"

#include <array>
#include <limits>
#include <optional>

namespace nephroid::detail {

/// How the footprints of one light's photons are chosen.
struct FieldOptions {
    std::optional<double> smoothing{}; ///< s for all photons; if empty, `shape_tensor` chooses it for each
    bool stratified = false;           ///< whether the photons come from a stratified sequence
    bool repeats = false;              ///< whether the scene repeats over the light's domain
    double scale = 1;                  ///< factor of S: the biweight's second moment over the kernel's own
    double photons = 0;                ///< emitted into this domain by the whole pass, not only by the pilot
    SmoothingBounds bounds{};
    double largest_miss = std::numeric_limits<double>::infinity(); ///< SecondOrder::largest_miss
};

/// The value of a field for one photon, in its own emission frame.
struct FieldSample {
    Symmetric2 shape;              ///< S, the shape of the footprint
    Plane2 divergence;             ///< ∂_a S_ab
    std::array<Double3, 3> second; ///< H, the second derivatives of the map
    bool as_published = false; ///< whether photons contradict the group's map in so many cells that all are splatted
                               ///< where they land
};

} // namespace nephroid::detail
