// SPDX-License-Identifier: MIT
/// @file  What the page of a comparison says beside its tables.
#pragma once

#include "common/study/page.hpp"
#include "common/study/trial.hpp"

namespace nephroid::examples::study::compare {

/// What was measured and how, and on what; the reference, splatting of either order and the first rival, whole.
///
/// @param pictures  the folder of `write_pictures`, with reference.png
void begin_page(Page& page, const Options& options, const Bench& bench, const std::vector<Trial>& trials,
                const std::filesystem::path& pictures);

/// The methods that were compared, and where they are from.
void end_page(Page& page, const Options& options);

} // namespace nephroid::examples::study::compare
