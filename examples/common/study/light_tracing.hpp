// SPDX-License-Identifier: MIT
/// @file  Plain light tracing: no estimate of density at all.
#pragma once

#include "common/study/methods.hpp"

namespace nephroid::examples::study {

/// Adds each photon's flux, over the pixel's area, to the pixel that it lands in: unbiased, and as noisy as photons are
/// few. The lamp aims at the specular objects, as for all methods. @param unused  as nothing is to choose
[[nodiscard]] Estimate count_in_pixels(const Bench& bench, const Photons& photons, double unused, Source source);

} // namespace nephroid::examples::study
