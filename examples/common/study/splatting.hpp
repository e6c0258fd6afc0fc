// SPDX-License-Identifier: MIT
/// @file  The methods that splat photons onto a map of eye path vertices.
#pragma once

#include "common/study/methods.hpp"

namespace nephroid::examples::study {

/// Photon differential splatting, of first order. @param smoothing  s
[[nodiscard]] Estimate splat(const Bench& bench, const Photons& photons, double smoothing, Source source);

/// Of second order: each photon where its bias cancels. Traces photons anew even if they are stored, as it needs to
/// know where they were emitted. @param smoothing  s
[[nodiscard]] Estimate splat_second_order(const Bench& bench, const Photons& photons, double smoothing, Source source);

/// Of second order, each photon's smoothing chosen from the photons around it. @param unused  as nothing is to choose
[[nodiscard]] Estimate splat_without_parameter(const Bench& bench, const Photons& photons, double unused,
                                               Source source);

/// The same with a smoothing that shrinks from pass to pass. @param smoothing  of the first pass, among its photons
[[nodiscard]] Estimate splat_progressively(const Bench& bench, const Photons& photons, double smoothing, Source source);

/// Disks of one radius, through the same pixel filter. @param radius  world units
[[nodiscard]] Estimate splat_disks(const Bench& bench, const Photons& photons, double radius, Source source);

} // namespace nephroid::examples::study
