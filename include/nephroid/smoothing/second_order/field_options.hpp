// SPDX-License-Identifier: MIT
/// @file  What chooses the footprints of one light's photons, and what is then said of one of them.
#pragma once

#include "nephroid/smoothing/policies.hpp"
#include "nephroid/smoothing/second_order/path_derivatives.hpp"
#include "nephroid/vector/plane.hpp"

#include <array>
#include <optional>

namespace nephroid::detail {

/// What chooses the footprints.
struct FieldOptions {
    std::optional<double> smoothing{}; ///< s for all photons; nothing: chosen for each by `smoothing_tensor`
    bool stratified = false;           ///< whether the photons come from a stratified sequence
    bool repeats = false;              ///< the scene repeats over the light's domain
    double scale = 1;                  ///< of S: the biweight's second moment over the kernel's own
    double photons = 0;                ///< emitted into this domain in all; those that the field is made from are fewer
    SmoothingBounds bounds{};
};

/// What the field says about one photon, in its own emission frame.
struct FieldSample {
    Symmetric2 shape;             ///< S
    Plane2 divergence;            ///< ∂_a S_ab
    std::array<Space3, 3> second; ///< H
};

} // namespace nephroid::detail
