// SPDX-License-Identifier: MIT
/// @file  Bounds on a photon's path.
#pragma once

#include "nephroid/vector/language.hpp"

namespace nephroid {

/// Bounds on a path. What they cut off is counted as Fate::terminated.
struct WalkLimits {
    unsigned specular_events = 64; ///< reflections and refractions before the photon is terminated
    unsigned roulette_after = 8;   ///< specular events before Russian roulette sets in; it kills a photon with the
                                   ///< probability that its flux has fallen to, and the survivors carry on for it
    unsigned bounces = 64;         ///< diffuse surfaces that a photon may go on from, where a visitor sends it on
    /// Where a visitor asks for all ways (transport/visitor.hpp), which knows no roulette:
    unsigned branches = 64;    ///< further ways that are followed for one photon
    double least_share = 1e-3; ///< of the photon's flux as emitted: a way that carries less is not followed. In [0, 1)
};

} // namespace nephroid
