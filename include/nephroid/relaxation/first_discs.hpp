// SPDX-License-Identifier: MIT
/// @file  The disc of K + 1 neighbours about where each photon begins: what its leash is measured by.
#pragma once

#include "nephroid/relaxation/leash.hpp"
#include "nephroid/relaxation/neighbourhood.hpp"
#include "nephroid/relaxation/photon_cloud.hpp"
#include "nephroid/relaxation/reach_guess.hpp"
#include "nephroid/relaxation/separation.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace nephroid::detail {

/// Sets the leash's radius of each photon to that of its disc. Photons in one place have no disc: their
/// radius is the distance to the nearest photon elsewhere. A photon with fewer than K + 1 others keeps 0, and so stays.
///
/// @param neighbours  K
/// @param searched    how many neighbours to search for, above K
/// @param reach       by slot: set to the distance of the last neighbour found
template <class Cloud, class E>
void measure_first_discs(const Cloud& cloud, std::size_t neighbours, std::size_t searched,
                         std::vector<typename Cloud::T>& reach, Leash<typename Cloud::T>& leash, E& executor) {
    using T = typename Cloud::T;
    for_each_leaf<Neighbourhood<Cloud>>(cloud.tree(), executor, [&](auto& around, std::uint32_t leaf) {
        guess_reach(cloud.tree(), cloud.tree().leaves()[leaf], searched, reach);
        std::optional<std::pair<std::size_t, T>> heap; // a photon that others coincide with, and the radius for all
        around.for_each(cloud, leaf, searched, reach, [&](std::size_t slot, std::span<Neighbour<T>> found) {
            reach[slot] = found.empty() ? T(0) : sqrt(found.back().distance2);
            if (found.size() <= neighbours)
                return;
            const T radius = sqrt(found[neighbours].distance2);
            if (radius > T(0))
                return leash.set_radius(slot, radius);
            if (!heap || !coincide(cloud, heap->first, slot))
                heap = {slot, distance_to_others(cloud, slot)};
            leash.set_radius(slot, heap->second);
        });
    });
}

} // namespace nephroid::detail
