// SPDX-License-Identifier: MIT
/// @file  Directions all around.
#pragma once

#include "nephroid/emission/warp.hpp"

namespace nephroid::tests {

/// Maps the square to the whole sphere, uniformly, about the z axis. The edge of the square becomes (0, 0, -1).
template <Vector3 V>
[[nodiscard]] V sphere_direction(scalar_t<V> u1, scalar_t<V> u2) {
    using T = scalar_t<V>;
    const V up = make_vector<V>(T(0), T(0), T(1));
    return cap_direction(up, frame_about(up), T(2), concentric_disk(u1, u2));
}

} // namespace nephroid::tests
