// SPDX-License-Identifier: MIT
/// @file  A photon map before and after its relaxation.
#pragma once

#include "common/study/relax/blue_noise.hpp"
#include "common/study/relax/look.hpp"

#include <optional>
#include <vector>

namespace nephroid::examples::study::relax {

/// A photon map and what it looks like.
struct PhotonMapLooks {
    double build_seconds = 0;
    std::vector<Look> looks;             ///< with each number of neighbours that the options name
    std::optional<Look> best;            ///< of the unrelaxed map's sweep, by relative error
    std::optional<Look> best_picture;    ///< of the same, by that of the exposed and clipped pictures
    std::optional<BlueNoise> blue_noise; ///< where there is evenly lit floor
};

struct BeforeAndAfter {
    PhotonMapLooks before, after;
    RelaxationReport relaxation;
    double relaxation_seconds = 0;
    std::vector<StoredPhoton> relaxed;
    std::vector<float> weights; ///< w of the features found, by photon; empty if none were looked for
    unsigned threads = 1;
};

/// Looks at the subject's photons, relaxes a copy of them and looks again.
[[nodiscard]] BeforeAndAfter before_and_after(const Subject& subject, const Options& options, ThreadExecutor& threads);

} // namespace nephroid::examples::study::relax
