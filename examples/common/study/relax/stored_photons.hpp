// SPDX-License-Identifier: MIT
/// @file  A scene's caustic photons, as many as the options want.
#pragma once

#include "common/caustic_photons.hpp"
#include "common/study/relax/subject.hpp"

#include "nephroid/gather/trace_photons.hpp"

#include <stdexcept>
#include <variant>
#include <vector>

namespace nephroid::examples::study::relax {

/// Traces `options.photons` caustic photons, more or less a few: a pilot pass finds how many to emit.
template <class S, Light L>
[[nodiscard]] std::vector<StoredPhoton> stored_photons(const S& scene, const L& light, const WalkLimits& limits,
                                                       const Options& options, ThreadExecutor& threads) {
    return std::visit(
        [&](const auto& sequence) {
            if (!(light.power() > 0))
                throw std::runtime_error("the lights emit nothing: their intensity or emission is zero");
            const PhotonPass pass{.count = emit_for(scene, light, options.photons, limits, sequence, threads),
                                  .limits = limits};
            const auto trace = trace_photons(scene, WithoutTangents(light), pass, sequence, threads);
            std::vector<StoredPhoton> photons;
            photons.reserve(trace.deposits.size());
            for (const auto& deposit : trace.deposits)
                photons.push_back({deposit.position, deposit.normal, deposit.direction, deposit.flux});
            return photons;
        },
        make_sequence(options.sequence, options.seed));
}

} // namespace nephroid::examples::study::relax
