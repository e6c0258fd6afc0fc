// SPDX-License-Identifier: MIT
/// @file  What a tile of a chart sends to the receiver.
#pragma once

#include "nephroid/sheet/sheet_block.hpp"

#include <cstdint>
#include <vector>

namespace nephroid::detail {

/// A leaf of the receiver, and a block that may light it.
struct BlockVisit {
    std::uint32_t leaf, block;
};

/// The pieces of a tile's sheets and the leaves that they may light, in the order of the tile's cells.
template <Vector3 V, Flux F>
struct TilePieces {
    SheetPieces<V, F> pieces;
    std::vector<BlockVisit> visits;

    void clear() {
        pieces.clear();
        visits.clear();
    }
};

} // namespace nephroid::detail
