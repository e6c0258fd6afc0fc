// SPDX-License-Identifier: MIT
/// @file  Scenes from seeds, to judge a rule on that was tuned elsewhere: mirrors and glass of many kinds over a floor,
///        under a sun, a point or a disk.
#pragma once

#include "common/builtin_cases.hpp"

#include <array>
#include <cstdint>
#include <string_view>

namespace nephroid::examples::study::judge {

/// What stands over the floor: water with a wave, a slab of glass with a wave on either side, a ball of glass, a mirror
/// ball, half a ring, and a wavy slab of triangles, with flat facets and with vertex normals.
inline constexpr std::array<std::string_view, 7> kinds = {"wave", "slab",   "glass-ball", "mirror-ball",
                                                          "ring", "facets", "mesh"};
inline constexpr std::array<std::string_view, 3> lamps = {"sun", "point", "disk"};

/// Sizes, places, indices, waves and the light's direction are drawn at random, the same for the same numbers.
///
/// @param kind  of `kinds`
/// @param lamp  of `lamps`
[[nodiscard]] BuiltinCase<float, float> scene_of(std::size_t kind, std::size_t lamp, std::uint64_t seed);

} // namespace nephroid::examples::study::judge
