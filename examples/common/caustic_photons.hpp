// SPDX-License-Identifier: MIT
/// @file  Computes how many photons to emit for a wanted number of caustic photons, or says what is wrong with the
///        scene.
#pragma once

#include "nephroid/execution/thread_executor.hpp"
#include "nephroid/pass/diagnose.hpp"
#include "nephroid/pass/photons_to_emit.hpp"

#include <cstdint>
#include <stdexcept>
#include <string>

namespace nephroid::examples {

/// Throws std::runtime_error if no photon makes a caustic, with the sentences of `diagnose` for the first few thousand.
template <class S, Light L, SampleSequence Sequence>
[[nodiscard]] std::uint64_t emit_for(const S& scene, const L& light, std::uint64_t wanted, const WalkLimits& limits,
                                     const Sequence& sequence, ThreadExecutor& threads) {
    const std::uint64_t emitted = photons_to_emit(scene, light, wanted, limits, sequence, threads);
    if (emitted > 0)
        return emitted;
    Statistics account;
    for (std::uint64_t i = 0; i < 4096; ++i) {
        Sampler<Sequence> sampler(sequence, i);
        (void)walk(scene, light.emit(sampler, {1, 1}), sampler, limits, account);
    }
    std::string message = "no photon makes a caustic";
    for (const std::string& sentence : diagnose(account))
        message += "; " + sentence;
    throw std::runtime_error(message);
}

} // namespace nephroid::examples
