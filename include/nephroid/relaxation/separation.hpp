// SPDX-License-Identifier: MIT
/// @file  In which direction photons in the same place move apart.
#pragma once

#include "nephroid/sequence/hash.hpp"
#include "nephroid/vector/frame.hpp"

#include <cmath>
#include <cstddef>

namespace nephroid::detail {

/// A unit vector in the tangent plane for one photon of a pair in the same place, and its opposite for the other.
///
/// Where two photons coincide, eq. 1 of Spencer and Jones 2009 gives the force a size, r τ, but no direction. This one
/// is random, and depends on the photons' indices alone.
template <class Cloud>
[[nodiscard]] typename Cloud::vector separation_direction(const Cloud& cloud, std::size_t slot, std::size_t other) {
    using V = typename Cloud::vector;
    using T = scalar_t<V>;
    const std::uint32_t i = cloud.tree().index(slot), j = cloud.tree().index(other);
    const std::size_t first = i < j ? slot : other;
    const double angle = 2 * pi<double> * uniform_from_bits<double>(hash_bits((std::min)(i, j), (std::max)(i, j)));
    const Frame<V> frame = frame_about(cloud.normal(first));
    const V direction = T(std::cos(angle)) * frame.u + T(std::sin(angle)) * frame.v;
    return i < j ? direction : -direction;
}

} // namespace nephroid::detail
