// SPDX-License-Identifier: MIT
/// @file  The policies of plain splatting: each photon where it lands, all with the same smoothing.
#pragma once

#include "nephroid/splat/splat.hpp"

namespace nephroid::tests {

using FirstOrderPolicies =
    SplatPolicies<BiweightKernel, PixelFilter, DiscardCollapsed, BoundMajorRadius, DifferentialFootprint, FirstOrder>;

} // namespace nephroid::tests
