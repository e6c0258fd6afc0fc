// SPDX-License-Identifier: MIT
/// @file  Vertices in groups of up to sixteen, with their pixel footprints, as light is added to them.
#pragma once

#include "nephroid/tree/box.hpp"
#include "nephroid/vector/scalar.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace nephroid::detail {

/// All that is read of a vertex while light is added to it.
template <Scalar T>
struct PixelRecord {
    std::array<T, 3> position;     ///< relative to the tree's origin
    std::array<T, 3> row_u, row_v; ///< dual to the footprint's sides: s = row_u · (x − position) + ½
    std::array<T, 3> normal;
    T inverse_area; ///< of the footprint
};

/// Up to sixteen neighbouring vertices.
template <Scalar T>
struct PixelGroup {
    static constexpr std::size_t most = 16;

    std::array<std::array<T, most>, 3> position; ///< by axis; beyond `size` it repeats the last one
    Box<T> box;                                  ///< about their footprints
    std::array<std::uint8_t, most> slot;         ///< of the leaf
    std::uint32_t size;
};

/// A leaf's groups.
template <Scalar T>
struct PixelLeaf {
    std::uint32_t first, size;
    Box<T> box;             ///< about its footprints; empty where they have no extent
    std::array<T, 3> reach; ///< how far a footprint goes from its vertex along each axis, the largest
    T pixel, largest;       ///< sides of the smallest and of the largest pixel: roots of the footprints' areas
    T area;                 ///< of all its footprints
};

/// How many of n vertices, more than sixteen, come into the first of two parts.
[[nodiscard]] constexpr std::size_t first_part(std::size_t n) {
    constexpr std::size_t most = PixelGroup<float>::most;
    return (std::min)(((n + most - 1) / most + 1) / 2 * most, n / 2 + most / 2);
}

/// Into how many groups n vertices are divided.
[[nodiscard]] constexpr std::uint32_t groups_in(std::size_t n) {
    return n <= PixelGroup<float>::most ? 1 : groups_in(first_part(n)) + groups_in(n - first_part(n));
}

/// Divides the vertices of a leaf across the longest side of their box, until no part has more than sixteen.
template <Scalar T>
class LeafParts {
public:
    static constexpr std::size_t most = 64; ///< vertices

    /// @param position  of the leaf's first vertex, by axis
    explicit LeafParts(const std::array<const T*, 3>& position) : position_(position) {}

    /// Calls visit(slots) for each part. Its order is that of `slots`.
    template <class Visit>
    void visit_parts(std::span<std::uint8_t> slots, const Visit& visit) const {
        if (slots.size() <= PixelGroup<T>::most) {
            visit(std::span<const std::uint8_t>(slots));
            return;
        }
        const std::size_t half = first_part(slots.size());
        divide(slots, half);
        visit_parts(slots.first(half), visit);
        visit_parts(slots.subspan(half), visit);
    }

private:
    /// Moves the vertices with the `half` smallest coordinates to the front.
    void divide(std::span<std::uint8_t> slots, std::size_t half) const {
        std::array<T, most> along{};
        T widest(-1), lowest(0);
        for (const T* const position : position_) {
            T low = position[slots[0]], high = low;
            std::array<T, most> values{};
            for (std::size_t i = 0; i < slots.size(); ++i) {
                values[i] = position[slots[i]];
                low = (std::min)(low, values[i]);
                high = (std::max)(high, values[i]);
            }
            if (high - low > widest) {
                along = values;
                widest = high - low;
                lowest = low;
            }
        }
        // Sorted by rank: comparing all pairs needs no branch. Keys are coordinates to a part in 2²⁴ of the width;
        // equal ones are told apart by their order.
        std::array<std::int32_t, most> key{}, rank{};
        const float width = float(widest), scale = width > 1e-30f && width < 1e30f ? 16777215.0f / width : 0.0f;
        for (std::size_t i = 0; i < slots.size(); ++i)
            key[i] = std::int32_t(scale > 0 ? float(along[i] - lowest) * scale : 0.0f) * std::int32_t(most) +
                     std::int32_t(i);
        for (std::size_t j = 0; j < slots.size(); ++j)
            for (std::size_t i = 0; i < most; ++i)
                rank[i] += std::int32_t(key[j] < key[i]);
        std::array<std::uint8_t, most> parted;
        std::size_t first = 0, second = half;
        for (std::size_t i = 0; i < slots.size(); ++i)
            parted[std::size_t(rank[i]) < half ? first++ : second++] = slots[i];
        std::copy_n(parted.begin(), slots.size(), slots.begin());
    }

    std::array<const T*, 3> position_;
};

} // namespace nephroid::detail
