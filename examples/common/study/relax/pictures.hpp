// SPDX-License-Identifier: MIT
/// @file  Pictures of a photon map before and after: what the maps look like, where the photons lie, spectra, plots.
#pragma once

#include "common/study/page.hpp"
#include "common/study/relax/before_and_after.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace nephroid::examples::study::relax {

/// Writes before-K.png and after-K.png for each number of neighbours K, before-best.png and truth.png where the truth
/// is known, dots-before.png, dots-after.png and features.png of photons on a floor, and spectrum-before.png and
/// spectrum-after.png where there is evenly lit floor.
/// @return  what was written, for the page
[[nodiscard]] std::vector<Exhibit> write_pictures(const std::filesystem::path& folder, const Subject& subject,
                                                  const BeforeAndAfter& measured);

/// Spectra and their anisotropy, and profiles across the subject's edges, as far as there are any.
[[nodiscard]] std::vector<Drawing> drawings(const Subject& subject, const BeforeAndAfter& measured);

} // namespace nephroid::examples::study::relax
