// SPDX-License-Identifier: MIT
/// @file  A chart of a lamp: a smooth map from the unit square to photons, without kinks.
///
/// Sheets join the photons of neighbouring points. A light's domain preserves areas, but its map has kinks on the
/// diagonals (emission/warp.hpp); a chart does not preserve areas, and has a density instead.
#pragma once

#include "nephroid/emission/photon.hpp"

#include <functional>
#include <optional>
#include <vector>

namespace nephroid {

/// A part of a lamp's emission as a function of (u, v) in the unit square.
template <Vector3 V, Flux F>
struct EmissionChart {
    using T = scalar_t<V>;

    /// emit(u, v) returns the photon of a point, or nothing where the lamp does not shine. Its flux is a *density*, per
    /// unit of the square's area. Smooth where the lamp shines; called from several threads.
    std::function<std::optional<Photon<V, F, 0>>(T, T)> emit;
    double width = 1, height = 1; ///< of the square's image, in any unit; cells are made about as wide as high in it
    double power = 0; ///< approximate flux of the square; a lamp's photons are divided among its charts by it
};

/// The charts of a lamp or of several lamps.
template <Vector3 V, Flux F>
using EmissionCharts = std::vector<EmissionChart<V, F>>;

} // namespace nephroid
