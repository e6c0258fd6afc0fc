// SPDX-License-Identifier: MIT
/// @file  What relaxation costs: time and memory per photon, by its parts.
#pragma once

#include "common/study/relax/options.hpp"
#include "common/table.hpp"

#include "nephroid/execution/thread_executor.hpp"

namespace nephroid::examples::study::relax {

/// Relaxes `options.photons` random photons of the unit square several times over: the least wall clock and processor
/// time per photon of each part, which are making the cloud with its tree, looking for features, the pilot densities,
/// and one iteration. On a machine that others use too the processor time is the one to trust.
[[nodiscard]] Table cost_table(const Options& options, ThreadExecutor& threads);

} // namespace nephroid::examples::study::relax
