// SPDX-License-Identifier: MIT
/// @file  The figures as CSV and JSON, for programs.
#pragma once

#include "common/compare/comparison.hpp"

namespace nephroid::examples {

/// Every evaluation; those that are best by a measure with their timing.
[[nodiscard]] std::string csv_text(const CompareOptions& options, const std::vector<Trial>& trials);

/// The same, with what it was measured on.
[[nodiscard]] std::string json_text(const CompareOptions& options, const Bench& bench,
                                    const std::vector<Trial>& trials);

} // namespace nephroid::examples
