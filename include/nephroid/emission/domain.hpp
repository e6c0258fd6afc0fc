// SPDX-License-Identifier: MIT
/// @file  The domain that a light emits from: its coordinates, where the map to rays is smooth, and where it ends.
#pragma once

#include "nephroid/vector/language.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace nephroid {

/// Lines in a square of two coordinates across which a light's map to rays has a kink. Elsewhere it is smooth.
enum class Kinks : unsigned char {
    nowhere,
    diagonals, ///< |u − ½| = |v − ½|: those of `concentric_disk`
    unknown,   ///< anywhere, and jumps too, such as between the triangles of a mesh
};

/// What lies at both ends of a coordinate, 0 and 1.
enum class DomainEdge : unsigned char {
    ends,    ///< a border of the light
    repeats, ///< no border: the coordinate is periodic
    closes,  ///< no border: the whole edge of the square is one ray
};

/// The meaning of a number that a light draws in addition to its coordinates.
enum class EmissionExtra : unsigned char { none, wavelength, time };

/// Describes a light's emission. A photon's ray is a function of its coordinates alone, each of which is in [0, 1).
///
/// A light draws its coordinates first, those of the position before those of the direction, and then its extras.
/// Fluxes and walks may depend on the extras, but photons that differ only in extras are still neighbours.
struct EmissionDomain {
    std::uint32_t coordinates = 2;         ///< 2 or 4: one pair for a point's directions or a beam's section, two for
                                           ///< an area light's positions and directions
    std::array<EmissionExtra, 2> extras{}; ///< drawn after the coordinates, in this order
    std::array<Kinks, 2> kinks{};          ///< of each pair of coordinates
    std::array<DomainEdge, 4> edges{};     ///< of each coordinate

    /// The number of extras.
    [[nodiscard]] constexpr std::uint32_t extra_count() const {
        std::uint32_t count = 0;
        for (std::size_t i = 0; i < extras.size(); ++i)
            count += extras[i] != EmissionExtra::none;
        return count;
    }
};

} // namespace nephroid
