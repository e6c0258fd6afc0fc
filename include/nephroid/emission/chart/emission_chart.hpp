// SPDX-License-Identifier: MIT
/// @file  A chart of a lamp: a square, each of whose points is a photon, with no kinks inside.
///
/// Sheets join the photons of neighbouring points. What a light's own numbers map to (emission/warp.hpp) keeps areas,
/// but has kinks on the diagonals; a chart gives up equal areas, and keeps account of the density.
#pragma once

#include "nephroid/emission/photon.hpp"

#include <functional>
#include <optional>
#include <vector>

namespace nephroid {

/// A part of a lamp's emission, by (u, v) in the unit square.
template <Vector3 V, Flux F>
struct EmissionChart {
    using T = scalar_t<V>;

    /// emit(u, v) -> the photon that leaves there. Its flux is a *density*: what is emitted per unit of the square's
    /// area around it. Nothing where the lamp does not shine. Smooth where it does; called from several threads.
    std::function<std::optional<Photon<V, F, 0>>(T, T)> emit;
    double width = 1, height = 1; ///< of the square as the light sees it, in any unit: cells are to be about as wide
                                  ///< as high
    double power = 0;             ///< Σ of the flux over the square, about; shares photons among a lamp's charts
};

/// Of a lamp or of several.
template <Vector3 V, Flux F>
using EmissionCharts = std::vector<EmissionChart<V, F>>;

} // namespace nephroid
