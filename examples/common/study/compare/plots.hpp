// SPDX-License-Identifier: MIT
/// @file  Error against time, photons and bandwidth, as plots.
#pragma once

#include "common/study/plot.hpp"
#include "common/study/trial.hpp"

namespace nephroid::examples::study::compare {

/// For each sequence and measure: error against time (the headline, "time-…"), against photons with fitted slopes if
/// there are several counts ("photons-…"), against bandwidth for the smallest count ("bandwidth-…"). Lines have the
/// names of the methods' ids.
[[nodiscard]] std::vector<Drawing> drawings(const Options& options, const std::vector<Trial>& trials);

} // namespace nephroid::examples::study::compare
