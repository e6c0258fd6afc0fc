// SPDX-License-Identifier: MIT
/// @file  How light sheets are made, and what is told of them.
#pragma once

#include "nephroid/sheet/refinement.hpp"
#include "nephroid/sheet/sheet_account.hpp"
#include "nephroid/sheet/tessellation.hpp"
#include "nephroid/transport/account.hpp"

#include <cstddef>

namespace nephroid {

/// How light sheets are made.
struct SheetOptions {
    Tessellation tessellation{};
    Refinement refinement{};
    std::size_t lamp_points = 64; ///< that stand for a lamp with extent, >= 1
};

/// What became of the light, and of its sheets.
struct SheetStatistics {
    Statistics light;          ///< emitted.flux is the sum over all fates and `unresolved`
    SheetAccount sheets;       ///< how much is whole and cut
    double without_charts = 0; ///< power of lamps that have no charts: nothing is drawn of them
    double unresolved = 0; ///< flux of nodes that landed less that of the sheets between them: what lies between nodes
                           ///< and was not met, or was taken for more than it is
};

/// Nobody takes over what is broken: it is drawn as well as may be, and counted.
struct DrawBroken {};

} // namespace nephroid
