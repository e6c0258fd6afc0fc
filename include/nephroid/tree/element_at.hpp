// SPDX-License-Identifier: MIT
/// @file  An element of a user's range by its number.
#pragma once

#include "nephroid/vector/language.hpp"

#include <cstddef>
#include <ranges>

namespace nephroid::detail {

/// range[i], for ranges without that operator too, and for numbers that are not of the range's own type.
template <std::ranges::random_access_range Range>
[[nodiscard]] decltype(auto) element_at(Range& range, std::size_t i) {
    return std::ranges::begin(range)[std::ranges::range_difference_t<Range>(i)];
}

} // namespace nephroid::detail
