// SPDX-License-Identifier: MIT
/// @file  The nine nodes of a block of 2 × 2 cells: whether one sheet goes through them all, and how well a patch
///        through the corners predicts the others.
#pragma once

#include "nephroid/sheet/cell_tangents.hpp"
#include "nephroid/sheet/hermite_patch.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace nephroid::detail {

/// The nodes' ends, by row and column.
template <Vector3 V, Flux F>
using NodeBlock = std::array<std::array<NodeEnds<V, F>, 3>, 3>;

/// The nodes of a block.
/// @param at  at(place) -> NodeEnds
template <Vector3 V, Flux F, class At>
[[nodiscard]] NodeBlock<V, F> block_at(const LatticePlace& place, std::int64_t step, const At& at) {
    NodeBlock<V, F> block;
    for (std::int64_t j = 0; j < 3; ++j)
        for (std::int64_t i = 0; i < 3; ++i)
            block[std::size_t(j)][std::size_t(i)] = at(LatticePlace{place.i + i * step, place.j + j * step});
    return block;
}

/// Whether no node met anything.
template <Vector3 V, Flux F>
[[nodiscard]] bool is_empty(const NodeBlock<V, F>& block) {
    for (const auto& row : block)
        for (const NodeEnds<V, F>& ends : row)
            if (!ends.empty())
                return false;
    return true;
}

/// How many nodes met something.
template <Vector3 V, Flux F>
[[nodiscard]] std::size_t count_lit(const NodeBlock<V, F>& block) {
    std::size_t lit = 0;
    for (const auto& row : block)
        for (const NodeEnds<V, F>& ends : row)
            lit += std::size_t(!ends.empty());
    return lit;
}

/// Whether all nine nodes have an end with this signature, and neighbours among them are joined.
template <Vector3 V, Flux F>
[[nodiscard]] bool is_whole(const NodeBlock<V, F>& block, std::uint32_t signature, double pixel) {
    std::array<std::array<const NodeEnd<V, F>*, 3>, 3> end;
    for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t i = 0; i < 3; ++i)
            if (end[j][i] = end_of<V, F>(block[j][i], signature); !end[j][i])
                return false;
    const auto size = [pixel] { return pixel; };
    for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t i = 0; i < 2; ++i)
            if (!are_joined(*end[j][i], *end[j][i + 1], size) || !are_joined(*end[i][j], *end[i + 1][j], size))
                return false;
    return true;
}

/// How far a block's patch misses, and how large it is.
struct Miss {
    double furthest = 0, size = 0; ///< world units; size: the patch's longest side
};

/// How far the patch through the block's four corners misses the five nodes between them.
/// @param known  known(place) -> NodeEnds: nodes that have been traced
template <Vector3 V, Flux F, class Known>
[[nodiscard]] Miss largest_miss(const NodeBlock<V, F>& block, const LatticePlace& place, std::int64_t step,
                                const Known& known, std::uint32_t signature, double pixel) {
    const auto size = [pixel] { return pixel; };
    PatchCorners corners;
    for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t j = 0; j < 2; ++j) {
            const NodeEnd<V, F>& node = *end_of<V, F>(block[2 * j][2 * i], signature);
            const LatticePlace at{place.i + std::int64_t(2 * i) * step, place.j + std::int64_t(2 * j) * step};
            corners[i][j] = {double3(node.position), change_along<V, F>(node, at, {2 * step, 0}, known, size),
                             change_along<V, F>(node, at, {0, 2 * step}, known, size)};
        }
    const HermitePatch patch(corners);
    Miss miss;
    for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t i = 0; i < 3; ++i) {
            if (i != 1 && j != 1)
                continue;
            const Double3 traced = double3(end_of<V, F>(block[j][i], signature)->position);
            miss.furthest = (std::max)(miss.furthest, length(traced - patch(0.5 * double(i), 0.5 * double(j))));
        }
    const auto& c = corners;
    miss.size = (std::max)({length(c[1][0].position - c[0][0].position), length(c[1][1].position - c[0][1].position),
                            length(c[0][1].position - c[0][0].position), length(c[1][1].position - c[1][0].position)});
    return miss;
}

} // namespace nephroid::detail
