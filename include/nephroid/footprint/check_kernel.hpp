// SPDX-License-Identifier: MIT
/// @file  Checks that a kernel's integral is 1. With another integral the whole picture would be too bright or too
///        dark.
#pragma once

#include "nephroid/footprint/kernel.hpp"
#include "nephroid/vector/error.hpp"
#include "nephroid/vector/text.hpp"

#include <cmath>
#include <type_traits>

namespace nephroid::detail {

/// The integral of a kernel over the unit disk, by the midpoint rule over r²: to 1e-6 for polynomials of r² and
/// Gaussians, to 1e-4 where the slope is infinite at the centre.
template <class K>
[[nodiscard]] double kernel_integral(const K& kernel) {
    using T = std::conditional_t<MapsRadius2<K, double>, double, float>;
    constexpr int steps = 1024;
    double sum = 0;
    for (int i = 0; i < steps; ++i)
        sum += double(kernel(T((i + 0.5) / steps)));
    return pi<double> / steps * sum;
}

/// Throws std::invalid_argument for an integral that is not 1, to 1%, and for a kernel that reaches beyond the disk.
template <class K>
NEPHROID_NOINLINE void check_kernel(const K& kernel) {
    using T = std::conditional_t<MapsRadius2<K, double>, double, float>;
    const double integral = kernel_integral(kernel);
    if (!(std::abs(integral - 1) <= 0.01))
        invalid_argument("nephroid: the kernel's integral over the unit disk is " +
                         text_of(std::round(1e4 * integral) / 1e4) +
                         "; divide it by that, so that a footprint holds its photon's flux once");
    if (!(kernel(T(1)) == T(0)) || !(kernel(T(1.5)) == T(0)))
        invalid_argument("nephroid: the kernel is not zero outside of the unit disk, at r² = 1 and beyond; footprints "
                         "end there");
}

} // namespace nephroid::detail
