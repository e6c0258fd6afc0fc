// SPDX-License-Identifier: MIT
/// @file  A bicubic patch through four photons, with their tangents and Adini's twists.
#pragma once

#include "nephroid/vector/double3.hpp"

#include <array>
#include <cstddef>

namespace nephroid::detail {

/// What a photon at a corner of a cell gives to its patch.
struct PatchCorner {
    Double3 position;         ///< relative to the receiver's origin
    Double3 along_u, along_v; ///< how the position changes over the cell's sides, world units
};

/// Corners of a cell: [i][j] at u = i, v = j.
using PatchCorners = std::array<std::array<PatchCorner, 2>, 2>;

/// The position's mixed second derivative at a corner, from the boundary's curves alone [Adini; see Barnhill and
/// Gregory 1975, "Compatible smooth interpolation in triangles"]: exact for biquadratic maps without the term u²v².
[[nodiscard]] inline Double3 adini_twist(const PatchCorners& c, std::size_t i, std::size_t j) {
    const Double3 u_change = c[i][1].along_u - c[i][0].along_u, v_change = c[1][j].along_v - c[0][j].along_v;
    const Double3 corners = (c[0][0].position - c[1][0].position) - (c[0][1].position - c[1][1].position);
    return (u_change + v_change) - corners;
}

/// A point of the patch is Σ_kl coefficient[k][l] u^k v^l, u and v in [0, 1].
class HermitePatch {
public:
    explicit HermitePatch(const PatchCorners& c) {
        // Cubics in v of the position and of its derivative by u, at u = 0 and at u = 1.
        const auto powers = [](const Double3& from, const Double3& to, const Double3& slope, const Double3& slope_to) {
            const Double3 way = to - from;
            return std::array<Double3, 4>{from, slope, 3.0 * way - (2.0 * slope + slope_to),
                                          (slope + slope_to) - 2.0 * way};
        };
        std::array<std::array<Double3, 4>, 2> value, change;
        for (std::size_t i = 0; i < 2; ++i) {
            value[i] = powers(c[i][0].position, c[i][1].position, c[i][0].along_v, c[i][1].along_v);
            change[i] = powers(c[i][0].along_u, c[i][1].along_u, adini_twist(c, i, 0), adini_twist(c, i, 1));
        }
        for (std::size_t l = 0; l < 4; ++l) {
            const std::array<Double3, 4> column = powers(value[0][l], value[1][l], change[0][l], change[1][l]);
            for (std::size_t k = 0; k < 4; ++k)
                coefficient_[l][k] = column[k];
        }
    }

    /// The patch at one v: a cubic in u.
    [[nodiscard]] std::array<Double3, 4> curve_at(double v) const {
        std::array<Double3, 4> curve;
        for (std::size_t k = 0; k < 4; ++k)
            curve[k] =
                coefficient_[0][k] + v * (coefficient_[1][k] + v * (coefficient_[2][k] + v * coefficient_[3][k]));
        return curve;
    }

    [[nodiscard]] static Double3 on(const std::array<Double3, 4>& curve, double u) {
        return curve[0] + u * (curve[1] + u * (curve[2] + u * curve[3]));
    }

    [[nodiscard]] Double3 operator()(double u, double v) const { return on(curve_at(v), u); }

private:
    std::array<std::array<Double3, 4>, 4> coefficient_; ///< by power of v, then of u
};

} // namespace nephroid::detail
