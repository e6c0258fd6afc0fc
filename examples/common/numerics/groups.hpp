// SPDX-License-Identifier: MIT
/// @file  The groups of hard cases.
#pragma once

#include <array>

namespace nephroid::examples::numerics {

enum class Group : unsigned char {
    ordinary,
    grazing_899,
    grazing_8999,
    below_critical,
    beyond_critical,
    normal_incidence,
    near_fold,
    far_away,
    tiny_scene,
    huge_scene,
    faint_index,
    small_radius,
    long_transfer,
};

inline constexpr std::array<const char*, 13> group_names = {"ordinary",
                                                            "grazing, 89.9 degrees",
                                                            "grazing, 89.99 degrees",
                                                            "below the critical angle",
                                                            "beyond the critical angle",
                                                            "normal incidence",
                                                            "near a fold",
                                                            "1e4 to 1e6 from the origin",
                                                            "a scene 1e-4 in size",
                                                            "a scene 1e4 in size",
                                                            "index ratio 1.0001",
                                                            "a radius of 1e-4",
                                                            "a transfer of 1e5"};

} // namespace nephroid::examples::numerics
