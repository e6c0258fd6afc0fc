// SPDX-License-Identifier: MIT
/// @file  A photon: a ray, the flux that it carries, and the tangents that give it a footprint.
#pragma once

#include "nephroid/differential/tangent.hpp"
#include "nephroid/emission/flux.hpp"

namespace nephroid {

/// @tparam F  flux: float for monochrome, the renderer's colour, spectral bands; watts
/// @tparam N  tangents: two unless the scene asks for more
template <Vector3 V, Flux F, std::size_t N = 2>
struct Photon {
    using vector = V;
    using flux_type = F;
    static constexpr std::size_t tangent_count = N;

    V position;  ///< world units
    V direction; ///< unit
    F flux;      ///< of this photon alone: the light's power over the number of photons emitted, less what was lost
    PhotonDifferential<V, N> differential;
};

} // namespace nephroid
