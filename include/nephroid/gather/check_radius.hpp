// SPDX-License-Identifier: MIT
/// @file  Checks of radii and other options of estimators, with error messages.
#pragma once

#include "nephroid/vector/scalar.hpp"
#include "nephroid/vector/text.hpp"

#include <cmath>
#include <string>

namespace nephroid::detail {

/// Refuses an option that is not positive, or not finite unless infinity means that there is no bound.
inline void check_positive(const char* who, const char* name, double value, bool may_be_infinite) {
    if (!(value > 0) || (!may_be_infinite && !std::isfinite(value)))
        invalid_argument(std::string(who) + ": " + name + " is " + text_of(value) + "; it must be positive" +
                         (may_be_infinite ? "" : " and finite"));
}

/// Besides, refuses a radius whose square leaves the range of T: estimates divide by it.
template <Scalar T>
void check_radius(const char* who, const char* name, double radius, bool may_be_infinite) {
    check_positive(who, name, radius, may_be_infinite);
    const T radius2 = square(T(radius));
    if (!(radius2 > T(0)) || !isfinite(T(T(1) / radius2)) || (!may_be_infinite && !isfinite(radius2)))
        invalid_argument(std::string(who) + ": " + name + " is " + text_of(radius) +
                         ", whose square the scalar type cannot hold; use another unit of length");
}

} // namespace nephroid::detail
