// SPDX-License-Identifier: MIT
/// @file  Whether photons lie around one on all sides, and so no border of the map crosses its disc.
#pragma once

#include "nephroid/tree/nearest_points.hpp"
#include "nephroid/vector/frame.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>

namespace nephroid::detail {

/// Whether photons lie in each of the 16 eighths of a ring at the rim of a photon's disc that begin at a multiple of a
/// sixteenth of the circle. An empty arc of three sixteenths or more contains one of them and is always found; one
/// between two and three may pass. The ring is so narrow that twelve photons lie in an eighth of it if the density is
/// even: none does by chance once in 160,000 times. Of discs of fewer than 192 photons the ring is the outer half, with
/// fewer photons in it, so that more of the discs that no border crosses fail: of 76 photons up to 14%, of 38 most.
///
/// A straight border is always found if it cuts more off the disc's weight (of Epanechnikov's kernel) than 8.3% of up
/// to 192 photons, 4.5% of 300, 2.3% of 600, or 1.6% of 1200: it then leaves three sixteenths of the ring empty.
/// Smaller cuts may pass, so that small discs see less of a border than large ones.
///
/// @param around   the photons of the disc, in any order
/// @param radius2  of the disc, squared
template <class Cloud>
[[nodiscard]] bool surrounded(const Cloud& cloud, std::size_t slot,
                              std::span<const Neighbour<typename Cloud::T>> around, typename Cloud::T radius2) {
    using V = typename Cloud::vector;
    using T = typename Cloud::T;
    const Frame<V> frame = frame_about(cloud.normal(slot));
    const T ring = (std::min)(T(0.5), T(8 * 12) / T(around.size()));
    std::uint16_t sixteenths = 0; // of the ring that hold a photon
    for (const Neighbour<T>& other : around) {
        if (!(other.distance2 > (T(1) - ring) * radius2))
            continue;
        const V offset = cloud.position(other.slot) - cloud.position(slot);
        const double turn = std::atan2(double(dot(offset, frame.v)), double(dot(offset, frame.u))) / std::numbers::pi;
        sixteenths = std::uint16_t(sixteenths | 1u << (unsigned(8 * (turn + 1)) % 16));
    }
    return (sixteenths | std::rotl(sixteenths, 1)) == 0xffff;
}

} // namespace nephroid::detail
