// SPDX-License-Identifier: MIT
/// @file  The figures as CSV and JSON, for programs.
#pragma once

#include "common/study/trial.hpp"

namespace nephroid::examples::study {

/// The names of the columns.
[[nodiscard]] std::string csv_header();
/// Every evaluation of the trials of one case; those that are best by a measure with their timing.
[[nodiscard]] std::string csv_rows(const std::string& scene, const std::vector<Trial>& trials);

/// The same, with what it was measured on.
/// @param command  as the program was called
[[nodiscard]] std::string json_text(const Options& options, const Bench& bench, const std::vector<Trial>& trials,
                                    const std::string& command);

} // namespace nephroid::examples::study
