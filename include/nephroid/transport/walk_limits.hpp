// SPDX-License-Identifier: MIT
/// @file  Bounds on a photon's path.
#pragma once

#include "nephroid/vector/language.hpp"

namespace nephroid {

/// Bounds on a path. The flux that they cut off is booked as Fate::terminated.
struct WalkLimits {
    unsigned specular_events = 64; ///< reflections and refractions before the photon is terminated
    unsigned roulette_after = 8;   ///< specular events before Russian roulette begins: a photon then survives with a
                                   ///< probability of its flux over the emitted one, and gets the emitted flux back
    unsigned diffuse_bounces = 64; ///< diffuse surfaces that a photon goes on from. In a closed scene of albedo 1 light
                                   ///< never ends; what is left of it then is cut off here
    /// For visitors that follow all ways (transport/visitor.hpp), without roulette:
    unsigned branches = 64;    ///< additional ways that are followed for one photon
    double least_share = 1e-3; ///< of the emitted flux: a way that carries less is not followed. In [0, 1)
};

} // namespace nephroid
