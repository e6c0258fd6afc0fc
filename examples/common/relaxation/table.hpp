// SPDX-License-Identifier: MIT
/// @file  What `relaxation` says at the end, and the same as a .csv file.
#pragma once

#include "common/relaxation/study.hpp"

#include <iosfwd>
#include <string>

namespace nephroid::examples::relaxation {

void print_table(std::ostream& out, const Options& options, const Subject& subject, const Study& study);

/// A line for each map and number of neighbours; what is not known is empty.
[[nodiscard]] std::string csv_text(const Subject& subject, const Study& study);

} // namespace nephroid::examples::relaxation
