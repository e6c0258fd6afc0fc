// SPDX-License-Identifier: MIT
/// @file  A photon where its light is seen: on a diffuse surface.
#pragma once

#include "nephroid/emission/flux.hpp"
#include "nephroid/vector/traits.hpp"

#include <array>
#include <cstddef>

namespace nephroid {

/// A photon on a diffuse surface.
///
/// @tparam N  tangents
template <Vector3 V, Flux F, std::size_t N = 2>
struct Deposit {
    V position;
    V normal;    ///< geometric, unit, on the side that the photon came from
    V direction; ///< of flight, unit
    F flux;
    std::array<V, N> d_position; ///< in the tangent plane
};

} // namespace nephroid
