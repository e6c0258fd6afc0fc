// SPDX-License-Identifier: MIT
/// @file  How many photons to emit for a wanted number of caustic photons: a pilot pass.
#pragma once

#include "nephroid/emission/light.hpp"
#include "nephroid/emission/spread.hpp"
#include "nephroid/execution/thread_executor.hpp"
#include "nephroid/sequence/sequence.hpp"
#include "nephroid/transport/walk.hpp"

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace nephroid::examples {

/// The share of emitted photons that become caustic photons, from the first few thousand of the very sequence that
/// the picture is made with; more of them where caustics are rare.
/// Throws std::runtime_error if none of four million does.
template <class S, Light L, SampleSequence Sequence>
[[nodiscard]] double caustic_share(const S& scene, const L& light, const WalkLimits& limits, const Sequence& sequence,
                                   ThreadExecutor& threads) {
    constexpr std::size_t chunk = 1024, enough = 256, most = std::size_t(1) << 22;
    const Spread<scalar_t<typename L::vector>> spread{1, 1};
    std::size_t found = 0, tried = 0;
    for (std::size_t wanted = 4 * chunk; tried < most && found < enough; wanted *= 4) {
        std::vector<std::size_t> counts((wanted - tried) / chunk);
        threads(counts.size(), [&](std::size_t c) {
            Statistics unused;
            for (std::size_t i = tried + c * chunk; i < tried + (c + 1) * chunk; ++i) {
                Sampler<Sequence> sampler(sequence, i);
                const auto photon = light.emit(sampler, spread);
                counts[c] += walk(scene, photon, sampler, limits, unused).has_value();
            }
        });
        for (const std::size_t count : counts)
            found += count;
        tried = wanted;
    }
    if (found == 0)
        throw std::runtime_error("no photon of " + std::to_string(tried) +
                                 " reached a diffuse surface through a mirror or glass; is there a diffuse surface "
                                 "that the caustic falls on?");
    return double(found) / double(tried);
}

/// The photons to emit for `wanted` caustic ones, which are this share of all. Throws std::runtime_error for too many.
[[nodiscard]] inline std::uint64_t photons_to_emit(std::uint64_t wanted, double share) {
    const double emitted = std::ceil(double(wanted) / share);
    if (!(emitted < 1e18))
        throw std::runtime_error("--photons: too many; only one photon in " + std::to_string(std::lround(1 / share)) +
                                 " makes a caustic here");
    return static_cast<std::uint64_t>(emitted);
}

} // namespace nephroid::examples
