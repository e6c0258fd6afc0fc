// SPDX-License-Identifier: MIT
/// @file  What relaxation costs: time and memory per photon, by its parts.
#pragma once

#include "common/relaxation/options.hpp"

#include "nephroid/execution/thread_executor.hpp"

#include <iosfwd>

namespace nephroid::examples::relaxation {

/// Relaxes `options.photons` random photons of the unit square several times over, and prints the least wall clock and
/// processor time per photon of each part: making the cloud with its tree, looking for features, the pilot densities,
/// and one iteration. On a machine that others use too the processor time is the one to trust.
void print_timing(std::ostream& out, const Options& options, ThreadExecutor& threads);

} // namespace nephroid::examples::relaxation
