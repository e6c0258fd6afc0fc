// SPDX-License-Identifier: MIT
/// @file  The spread of emitted photons, which determines the initial lengths of their tangents.
#pragma once

#include "nephroid/vector/scalar.hpp"

namespace nephroid {

/// The density of emitted photons: how many a light's domain is divided among, and how much their footprints overlap.
template <Scalar T>
struct Spread {
    T photons;   ///< N_e, the number the light's flux is divided by, > 0
    T smoothing; ///< s, > 0: at emission the footprints' areas add up to s² times the domain

    /// The length of each of two orthogonal tangents of a photon drawn uniformly from a domain of this measure (area,
    /// or solid angle in steradian): 2 s sqrt(measure / (π N)). For a photon drawn with a probability density p, pass
    /// a measure of 1/p. If the domain is a single point, its measure and the tangent's length are 0.
    /// Source: Frisvad et al. 2014, eq. 5 and 6; the density version is nephroid's.
    [[nodiscard]] T length(T measure) const { return T(2) * smoothing * sqrt(measure / (pi<T> * photons)); }
};

} // namespace nephroid
