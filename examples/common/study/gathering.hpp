// SPDX-License-Identifier: MIT
/// @file  The methods that store photons in a map and gather them at each eye path vertex.
#pragma once

#include "common/study/methods.hpp"

namespace nephroid::examples::study {

/// Standard photon mapping. @param count  k, a whole number
[[nodiscard]] Estimate gather_nearest(const Bench& bench, const Photons& photons, double count, Source source);
[[nodiscard]] Estimate gather_nearest_constant(const Bench& bench, const Photons& photons, double count, Source source);
/// @param count  k, which differential checking lessens
[[nodiscard]] Estimate gather_nearest_checked(const Bench& bench, const Photons& photons, double count, Source source);

/// Photon differential mapping: stored footprints. @param smoothing  s
/// The map of vertices that gives the pixel filter its width is not timed: a renderer knows its pixels' footprints.
[[nodiscard]] Estimate gather_differentials(const Bench& bench, const Photons& photons, double smoothing,
                                            Source source);

/// Diffusion-based photon mapping. Edges that have been found are kept for the rest of a sweep.
/// @param radius  h, world units
/// @param diffusivity  C
[[nodiscard]] Estimate gather_by_diffusion(const Bench& bench, const Photons& photons, double radius,
                                           double diffusivity, Source source);

/// Progressive photon mapping, with statistics at every vertex. @param radius  of the first pass, world units
[[nodiscard]] Estimate gather_progressively(const Bench& bench, const Photons& photons, double radius, Source source);
/// The same with one radius for all vertices.
[[nodiscard]] Estimate gather_by_shrinking_radius(const Bench& bench, const Photons& photons, double radius,
                                                  Source source);

} // namespace nephroid::examples::study
