// SPDX-License-Identifier: MIT
/// @file  What feature detection finds for one photon.
#pragma once

#include "nephroid/vector/traits.hpp"

namespace nephroid {

/// How a feature holds a photon: it moves along the feature, and less or not at all across.
template <Vector3 V>
struct PhotonConstraint {
    V direction;        ///< g: unit, in the tangent plane, along the feature; zero where there is none
    scalar_t<V> weight; ///< w: 0 moves freely, 1 moves along g only
};

} // namespace nephroid
