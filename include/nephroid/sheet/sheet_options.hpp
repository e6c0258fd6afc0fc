// SPDX-License-Identifier: MIT
/// @file  How light sheets are made, and what is reported of them.
#pragma once

#include "nephroid/sheet/refinement.hpp"
#include "nephroid/sheet/sheet_account.hpp"
#include "nephroid/sheet/tessellation.hpp"
#include "nephroid/transport/account.hpp"
#include "nephroid/vector/error.hpp"
#include "nephroid/vector/text.hpp"

#include <cmath>
#include <cstddef>
#include <string>

namespace nephroid {

/// How light sheets are made.
struct SheetOptions {
    Tessellation tessellation{};  ///< how finely a patch is divided into flat quads
    Refinement refinement{};      ///< how far cells are split where a sheet bends or ends
    std::size_t lamp_points = 64; ///< that stand for a lamp with area, >= 1
};

namespace detail {
/// Throws std::invalid_argument for options out of their range.
///
/// @param caller  name of the calling function, for the message
NEPHROID_NOINLINE inline void check(const SheetOptions& options, const char* caller) {
    const auto require = [caller](bool holds, const char* name, double value, const char* rule) {
        if (!holds)
            invalid_argument(std::string(caller) + ": " + name + " is " + text_of(value) + "; it must be " + rule);
    };
    const auto is_positive = [](double x) { return x > 0 && std::isfinite(x); };
    const Tessellation& quads = options.tessellation;
    require(is_positive(quads.bend), "tessellation.bend", quads.bend, "positive and finite");
    require(is_positive(quads.density), "tessellation.density", quads.density, "positive and finite");
    require(quads.max_quads >= 1 && quads.max_quads <= 32, "tessellation.max_quads", quads.max_quads, "from 1 to 32");
    const Refinement& cells = options.refinement;
    require(cells.levels <= 10, "refinement.levels", cells.levels, "at most 10");
    require(is_positive(cells.tolerance), "refinement.tolerance", cells.tolerance, "positive and finite");
    require(is_positive(cells.relative), "refinement.relative", cells.relative, "positive and finite");
    require(options.lamp_points >= 1, "lamp_points", double(options.lamp_points), "at least 1");
}
} // namespace detail

/// What became of the light, and of its sheets.
struct SheetStatistics {
    Statistics light;          ///< emitted.flux is the sum over all fates and `unresolved`
    SheetAccount sheets;       ///< how much of it is on sheets, and how well they could be drawn
    double without_charts = 0; ///< power of lamps that have no charts, in the unit of the flux: nothing of it is drawn
    double unresolved = 0; ///< flux of the nodes that landed, minus that of the sheets between them: above 0 for light
                           ///< that sheets miss, below 0 for light that they overestimate
};

/// The default: nobody takes broken parts over. They are drawn as well as possible, and counted.
struct DrawBroken {};

} // namespace nephroid
