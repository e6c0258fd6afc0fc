// SPDX-License-Identifier: MIT
/// @file  The policies of plain splatting: photons stay where they land, and all have the same smoothing.
#pragma once

#include "nephroid/splat/splat.hpp"

namespace nephroid::tests {

using FirstOrderPolicies =
    SplatPolicies<BiweightKernel, PixelFilter, DiscardCollapsed, BoundMajorRadius, DifferentialFootprint, FirstOrder>;

} // namespace nephroid::tests
