// SPDX-License-Identifier: MIT
/// @file  How many photons to emit for the caustic photons that the user wants, or what is wrong with the scene.
#pragma once

#include "nephroid/execution/thread_executor.hpp"
#include "nephroid/pass/photons_to_emit.hpp"

#include <cstdint>
#include <stdexcept>

namespace nephroid::examples {

/// Throws std::runtime_error if no photon makes a caustic.
template <class S, Light L, SampleSequence Sequence>
[[nodiscard]] std::uint64_t emit_for(const S& scene, const L& light, std::uint64_t wanted, const WalkLimits& limits,
                                     const Sequence& sequence, ThreadExecutor& threads) {
    const std::uint64_t emitted = photons_to_emit(scene, light, wanted, limits, sequence, threads);
    if (emitted == 0)
        throw std::runtime_error("no photon of four million reached a diffuse surface through a mirror or glass; is "
                                 "there a diffuse surface that the caustic falls on?");
    return emitted;
}

} // namespace nephroid::examples
