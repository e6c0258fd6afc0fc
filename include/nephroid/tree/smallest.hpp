// SPDX-License-Identifier: MIT
/// @file  Finds a limit that separates the smallest of some values from the others, by counting.
#pragma once

#include "nephroid/vector/scalar.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nephroid::detail {

/// The smallest values are those below the limit, and a number of those equal to it.
template <Scalar T>
struct SmallestLimit {
    T limit;
    std::size_t at_limit;
};

template <Scalar T>
[[nodiscard]] std::size_t count_below(std::span<const T> values, T limit) {
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
        count += std::uint32_t(values[i] < limit);
    return count;
}

/// Finds the limit by interpolation, in vectorised loops without branches. It is fast if values are spread evenly, as
/// squared distances on a surface are.
///
/// @param values  >= 0; none is a NaN
/// @param wanted  least number of smallest values, 1 to values.size()
/// @param spare   how many more there may be
/// @param high    upper bound of the values
template <Scalar T>
[[nodiscard]] SmallestLimit<T> limit_of_smallest(std::span<const T> values, std::size_t wanted, std::size_t spare,
                                                 T high) {
    T low(0);
    std::size_t below_low = 0, below_high = values.size();
    for (int tries = 0; tries < 6 && below_low < below_high; ++tries) {
        const T share = (T(wanted - below_low) + T(0.5) * T(spare)) / T(below_high - below_low);
        const T guess = low + share * (high - low);
        if (!(low < guess && guess < high))
            break;
        const std::size_t below = count_below<T>(values, guess);
        if (below >= wanted && below <= wanted + spare)
            return {guess, 0};
        (below < wanted ? below_low : below_high) = below;
        (below < wanted ? low : high) = guess;
    }
    // Usually several values are equal here.
    static thread_local std::vector<T> sorted;
    sorted.assign(values.begin(), values.end());
    const auto last = sorted.begin() + std::ptrdiff_t(wanted - 1);
    std::nth_element(sorted.begin(), last, sorted.end());
    return {*last, wanted - count_below<T>(values, *last)};
}

} // namespace nephroid::detail
