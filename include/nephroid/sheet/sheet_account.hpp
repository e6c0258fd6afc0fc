// SPDX-License-Identifier: MIT
/// @file  The account of light sheets: how much light is seen, how much is on cut cells, and how much is handed over.
#pragma once

#include "nephroid/emission/flux.hpp"
#include "nephroid/transport/account.hpp"

#include <cstdint>

namespace nephroid {

/// Counts cells, and books the flux on sheets.
struct SheetAccount {
    std::uint64_t nodes = 0;     ///< photons traced: corners of cells, and those that look for where sheets end
    std::uint64_t cells = 0;     ///< drawn
    std::uint64_t cut_cells = 0; ///< in which a sheet ends
    std::uint64_t parted = 0; ///< sides of cells whose ends share a path, and lie on different pieces of the receiver
    std::uint64_t by_chance = 0;    ///< nodes whose scene drew a random number: their paths are no sheets
    std::uint64_t capped = 0;       ///< blocks that should have been split, in tiles with too many nodes
    Tally seen;                     ///< on sheets that reach vertices
    Tally unseen;                   ///< on sheets that reach none
    Tally cut;                      ///< the part of both that is in cells in which a sheet ends
    std::uint64_t broken_tiles = 0; ///< parts of a chart with more than a third of their light in cells in which sheets
                                    ///< end; and, if broken parts are taken over, those whose scene drew random numbers
    Tally broken;                   ///< light of these, if nobody takes them over: it may be in the wrong place
    Tally handed_over;              ///< light of these, if they are taken over: none of it is drawn

    template <Flux F>
    void book(const F& flux, bool is_seen, bool is_cut) {
        const double power = flux_traits<F>::power(flux);
        (is_seen ? seen : unseen).add(power);
        if (is_cut)
            cut.add(power);
    }

    SheetAccount& operator+=(const SheetAccount& other) {
        nodes += other.nodes;
        cells += other.cells;
        cut_cells += other.cut_cells;
        parted += other.parted;
        by_chance += other.by_chance;
        capped += other.capped;
        seen += other.seen;
        unseen += other.unseen;
        cut += other.cut;
        broken_tiles += other.broken_tiles;
        broken += other.broken;
        handed_over += other.handed_over;
        return *this;
    }
};

} // namespace nephroid
