// SPDX-License-Identifier: MIT
/// @file  Light sheets as one of the methods.
#pragma once

#include "common/study/methods.hpp"

namespace nephroid::examples::study {

/// Draws sheets between about as many photons as the others have. They are traced anew, as cells are split where sheets
/// bend, whatever the sequence; the map of vertices has their pixels' footprints.
[[nodiscard]] Estimate draw_sheets(const Bench& bench, const Photons& photons, double bandwidth, Source source);

} // namespace nephroid::examples::study
