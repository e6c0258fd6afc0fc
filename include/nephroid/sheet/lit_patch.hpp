// SPDX-License-Identifier: MIT
/// @file  A patch of light, and how it lies on its receiver.
#pragma once

#include "nephroid/emission/flux.hpp"
#include "nephroid/sheet/hermite_patch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace nephroid::detail {

/// Light on a patch: a cell whose four photons took the same path.
template <Vector3 V, Flux F>
struct LitPatch {
    PatchCorners corners;
    std::array<std::array<Double3, 2>, 2> normal;    ///< of the receiver, on the light's side, unit
    std::array<std::array<Double3, 2>, 2> direction; ///< of flight, unit
    F flux;
};

/// Interpolates between values at the corners, [i][j] at u = i, v = j.
[[nodiscard]] inline Double3 bilinear(const std::array<std::array<Double3, 2>, 2>& at, double u, double v) {
    return (1 - v) * ((1 - u) * at[0][0] + u * at[1][0]) + v * ((1 - u) * at[0][1] + u * at[1][1]);
}

/// How a patch lies on its receiver.
struct PatchSag {
    double sag;       ///< the largest distance of a corner from another corner's tangent plane
    double curvature; ///< 2 sag over the square of the longer diagonal

    template <Vector3 V, Flux F>
    explicit PatchSag(const LitPatch<V, F>& patch) : sag(0) {
        const auto& c = patch.corners;
        for (std::size_t k = 0; k < 4; ++k)
            for (std::size_t l = 0; l < 4; ++l)
                sag = (std::max)(sag, std::abs(dot(patch.normal[k / 2][k % 2],
                                                   c[l / 2][l % 2].position - c[k / 2][k % 2].position)));
        const double diagonal2 =
            (std::max)(length2(c[1][1].position - c[0][0].position), length2(c[1][0].position - c[0][1].position));
        curvature = diagonal2 > 0 ? 2 * sag / diagonal2 : 0;
    }

    /// How near to a quad a vertex must be to lie on its surface, world units: a fiftieth of a pixel where the receiver
    /// is flat, so that light on a shelf misses the next one, plus how far the receiver bends over a quad and a pixel.
    [[nodiscard]] double thickness(double pixel, unsigned quads) const {
        return pixel / 50 + 2 * sag / quads + (std::min)(4 * curvature * pixel * pixel, pixel / 2);
    }

    /// Whether a block of quads may be drawn as if it lay in one plane.
    [[nodiscard]] bool is_flat(double pixel) const { return sag <= pixel / 100; }
};

} // namespace nephroid::detail
