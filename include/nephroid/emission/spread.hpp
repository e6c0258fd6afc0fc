// SPDX-License-Identifier: MIT
/// @file  How far apart emitted photons are: the initial lengths of their tangents.
#pragma once

#include "nephroid/vector/scalar.hpp"

namespace nephroid {

/// The density of an emission: how many photons share the light's domain, and how much their footprints overlap.
template <Scalar T>
struct Spread {
    T photons;   ///< N_e, the number the light's flux is divided by, > 0
    T smoothing; ///< s, > 0: at emission the footprints' areas add up to s² times the domain

    /// The length of each of two orthogonal tangents of a photon drawn uniformly from a domain of this measure
    /// (area, or solid angle in steradian): 2 s sqrt(measure / (π N)). A photon drawn with a probability density p
    /// stands for a measure of 1/p: pass that. A domain that is a point has measure 0, and so has the tangent.
    /// Source: Frisvad et al. 2014, eq. 5 and 6; the density version is nephroid's.
    [[nodiscard]] T length(T measure) const { return T(2) * smoothing * sqrt(measure / (pi<T> * photons)); }
};

} // namespace nephroid
