// SPDX-License-Identifier: MIT
/// @file  Scenes that are built in, open to all sides and y up, for pictures of caustics: a gold ring, a prism, a torus
///        in glass and a swimming pool.
#pragma once

#include "common/scenes/embedded_torus.hpp"
#include "common/scenes/gold_ring.hpp"
#include "common/scenes/prism.hpp"
#include "common/scenes/swimming_pool.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace nephroid::examples {

/// gold-ring: a wedding ring on a table under a round lamp, after figures 1 and 2 of Frisvad et al. 2014. prism: flint
/// glass behind a slit in the sun, and a screen, after their figure 12; its colours need --bands. embedded-torus: a
/// torus in a block of glass, after their figure 13. swimming-pool: waves over tiles, after their figure 11.
inline constexpr std::array<std::string_view, 4> scene_names = {"gold-ring", "prism", "embedded-torus",
                                                                "swimming-pool"};

/// "gold-ring, prism, …"
[[nodiscard]] inline std::string names_of_scenes() {
    std::string names;
    for (const std::string_view name : scene_names)
        names += (names.empty() ? "" : ", ") + std::string(name);
    return names;
}

[[nodiscard]] inline bool is_scene(std::string_view name) {
    return std::find(scene_names.begin(), scene_names.end(), name) != scene_names.end();
}

/// @param name  one of `scene_names`; for another name, nothing is returned
template <class T, Flux F = Vec3<T>>
[[nodiscard]] std::optional<Room<T, F>> built_in_scene(std::string_view name) {
    if (name == "gold-ring")
        return detail::gold_ring_scene<T, F>();
    if (name == "prism")
        return detail::prism_scene<T, F>();
    if (name == "embedded-torus")
        return detail::embedded_torus_scene<T, F>();
    if (name == "swimming-pool")
        return detail::swimming_pool_scene<T, F>();
    return std::nullopt;
}

} // namespace nephroid::examples
