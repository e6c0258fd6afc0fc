// SPDX-License-Identifier: MIT
/// @file  Finds how many photons to emit for a wanted number of caustic photons, by a pilot pass.
#pragma once

#include "nephroid/emission/light.hpp"
#include "nephroid/emission/spread.hpp"
#include "nephroid/execution/checked_executor.hpp"
#include "nephroid/pass/call_arguments.hpp"
#include "nephroid/sequence/halton.hpp"
#include "nephroid/sequence/sequence.hpp"
#include "nephroid/transport/walk.hpp"
#include "nephroid/vector/error.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace nephroid {

namespace detail {
/// The share of emitted photons that become caustic photons. It is measured on the first few thousand photons of the
/// picture's own sequence, and on more of them if caustics are rare. 0 if none of four million does, or if none of
/// 262,144 meets a mirror or glass at all.
template <class S, class L, class Sequence, class E>
[[nodiscard]] double share_of_caustic_photons(const S& scene, const L& light, const WalkLimits& limits,
                                              const Sequence& sequence, E& executor) {
    constexpr std::size_t chunk = 1024, enough = 256, most = std::size_t(1) << 22;
    const Spread<scalar_t<typename L::vector>> spread{1, 1};
    constexpr std::size_t most_in_vain = std::size_t(1) << 18;
    std::size_t found = 0, tried = 0;
    bool has_met = false;
    for (std::size_t wanted = 4 * chunk; tried < most && found < enough; wanted *= 4) {
        if (tried >= most_in_vain && !has_met)
            return 0;
        std::vector<std::size_t> counts((wanted - tried) / chunk);
        std::vector<Statistics> accounts(counts.size());
        executor(counts.size(), [&](std::size_t c) {
            for (std::size_t i = tried + c * chunk; i < tried + (c + 1) * chunk; ++i) {
                Sampler<Sequence> sampler(sequence, i);
                counts[c] += walk(scene, light.emit(sampler, spread), sampler, limits, accounts[c]).has_value();
            }
        });
        for (std::size_t c = 0; c < counts.size(); ++c) {
            found += counts[c];
            has_met = has_met || accounts[c].specular_events > 0;
        }
        tried = wanted;
    }
    return double(found) / double(tried);
}
} // namespace detail

/// How many photons to emit so that about a wanted number of them become caustic photons. Give the result as
/// `PhotonPass::count`.
///
/// ```cpp
/// const auto count = nephroid::photons_to_emit(scene, light, 50'000, {}, threads);
/// nephroid::caustics(scene, light, sums, {.count = count}, threads);
/// ```
///
/// @param scene, light  as for `caustics`
/// @param wanted        number of photons that should reach a diffuse surface by way of a specular one
/// @param limits        of the pass
/// @param arguments     optional, in any order: the sequence of the pass, an executor. The result does not depend on
///                      the executor
/// @return  0 if no photon of 262,144 meets a mirror or glass (the light is not aimed at them), or if none of four
///          million becomes a caustic photon (there is no diffuse surface where the caustic falls). `diagnose`
///          (pass/diagnose.hpp) of a short pass tells which
/// Throws std::invalid_argument if 10^18 photons or more would be needed. Cost: 4096 photons, up to four million if
/// caustics are rare.
template <class S, class L, class... Arguments>
    requires(detail::MustBeOneOf<Arguments, detail::SequenceKind, detail::ExecutorKind>&&...)
[[nodiscard]] std::uint64_t photons_to_emit(const S& scene, const L& light, std::uint64_t wanted,
                                            const WalkLimits& limits = {}, Arguments&&... arguments) {
    const HaltonSequence sequence{};
    const SerialExecutor executor{};
    detail::CheckedExecutor checked(detail::argument_of<detail::ExecutorKind>(executor, arguments...));
    const double share = detail::share_of_caustic_photons(
        scene, light, limits, detail::argument_of<detail::SequenceKind>(sequence, arguments...), checked);
    if (share == 0)
        return 0;
    const double emitted = std::ceil(double(wanted) / share);
    if (!(emitted < 1e18))
        invalid_argument("nephroid::photons_to_emit: " + std::to_string(wanted) +
                         " caustic photons are too many; only one photon in " + std::to_string(std::lround(1 / share)) +
                         " makes a caustic here");
    return static_cast<std::uint64_t>(emitted);
}

} // namespace nephroid
