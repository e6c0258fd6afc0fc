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
    V position;  ///< world units
    V normal;    ///< geometric, unit, on the side that the photon came from
    V direction; ///< of flight, unit
    F flux;      ///< of this photon alone: the light's power over the number of photons emitted, less what was lost
    std::array<V, N> d_position; ///< in the tangent plane, world units: full lengths, of which s/2 are semi-axes
};

} // namespace nephroid
