// SPDX-License-Identifier: MIT
/// @file  Refuses lengths of ray policies that make no sense.
#pragma once

#include "nephroid/ray/ray_policies.hpp"
#include "nephroid/vector/error.hpp"
#include "nephroid/vector/text.hpp"

#include <cmath>
#include <string>

namespace nephroid::detail {

/// @param allows_zero  whether 0 has a meaning
inline void check_ray_number(const char* name, double value, bool allows_zero) {
    if (!(allows_zero ? value >= 0 : value > 0) || !std::isfinite(value))
        invalid_argument("nephroid::splat_rays: " + std::string(name) + " is " + text_of(value) + "; it must be " +
                         (allows_zero ? "zero or positive" : "positive") + ", and finite");
}

/// Throws std::invalid_argument that names what is wrong.
template <class Policies>
void check_rays(const Policies& policies) {
    check_ray_number("reach_behind", policies.reach_behind, false);
    if constexpr (requires { policies.width.radius; })
        check_ray_number("the width's radius", policies.width.radius, false);
    if constexpr (requires { policies.width.growth; })
        check_ray_number("the width's growth", policies.width.growth, true);
    if constexpr (requires { policies.width.start; })
        check_ray_number("the width's start", policies.width.start, true);
    if constexpr (requires { policies.width.start_spacings; })
        check_ray_number("the width's start_spacings", policies.width.start_spacings, false);
    if constexpr (requires { policies.border.least_radius; })
        check_ray_number("the border's least_radius", policies.border.least_radius, false);
    if constexpr (requires { policies.visibility.radii; })
        check_ray_number("the short rays' radii", policies.visibility.radii, false);
}

} // namespace nephroid::detail
