// SPDX-License-Identifier: MIT
/// @file  A few vertices with their pixels' footprints, as light is added to them.
#pragma once

#include "nephroid/tree/box.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace nephroid::detail {

/// All that is read of a vertex while light is added to it, in one line of cache (of floats).
template <Scalar T>
struct alignas(16 * sizeof(T)) PixelRecord {
    std::array<T, 3> position;     ///< relative to the tree's origin
    std::array<T, 3> row_u, row_v; ///< dual to the footprint's sides: s = row_u · (x − position) + ½
    std::array<T, 3> normal;
    T inverse_area;     ///< of the footprint
    std::uint32_t slot; ///< of the tree's leaf order
};

/// Up to sixteen neighbouring vertices.
template <Scalar T>
struct PixelGroup {
    static constexpr std::size_t most = 16;

    std::array<std::array<T, most>, 3> position; ///< by axis; beyond `size` it repeats the last one
    Box<T> box;                ///< about their footprints, with a little room for what lies just above or below
    std::array<T, 3> reach;    ///< how far a footprint goes from its vertex along each axis, the largest
    std::uint32_t first, size; ///< of the records
    T pixel, largest;          ///< the roots of the smallest and the largest footprint's area
};

/// A leaf's groups.
template <Scalar T>
struct PixelLeaf {
    std::uint32_t first, size;
    Box<T> box;   ///< about its footprints
    T pixel;      ///< the smallest of its groups'
    T largest{0}; ///< the root of the largest footprint's area
};

} // namespace nephroid::detail
