// SPDX-License-Identifier: MIT
/// @file  Into how many quads a patch is cut.
#pragma once

#include "nephroid/sheet/hermite_patch.hpp"

#include <algorithm>
#include <cmath>

namespace nephroid {

/// How finely patches of light are cut into flat quads. The errors of a picture's folds follow `bend`, those where
/// light is smooth follow `density`.
struct Tessellation {
    double bend = 0.01;      ///< how far a quad may miss the patch, in pixels; > 0
    double density = 0.03;   ///< how much the density of light may change over a quad, of itself; > 0
    unsigned max_quads = 32; ///< quads along each side at most, 1 to 32
};

namespace detail {

/// What the number of quads depends on.
struct PatchShape {
    double bend = 0;    ///< a quarter of the largest difference of a tangent and its chord, world units
    double change = 0;  ///< largest difference of the signed areas at the corners, over the largest area
    double longest = 0; ///< side, world units
};

/// @param normal  of the receiver, unit: areas are signed by it
[[nodiscard]] inline PatchShape shape_of(const PatchCorners& c, const Double3& normal) {
    PatchShape shape;
    double least = 0, most = 0;
    for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t j = 0; j < 2; ++j) {
            const Double3 chord_u = c[1][j].position - c[0][j].position, chord_v = c[i][1].position - c[i][0].position;
            shape.bend = (std::max)({shape.bend, length(c[i][j].along_u - chord_u), length(c[i][j].along_v - chord_v)});
            shape.longest = (std::max)({shape.longest, length(chord_u), length(chord_v)});
            const double area = dot(plain_cross(c[i][j].along_u, c[i][j].along_v), normal);
            const bool is_first = i + j == 0;
            least = is_first ? area : (std::min)(least, area);
            most = is_first ? area : (std::max)(most, area);
        }
    shape.bend *= 0.25;
    const double largest = (std::max)(std::abs(least), std::abs(most));
    shape.change = largest > 0 ? (most - least) / largest : 0;
    return shape;
}

/// The number of quads along each side: the same both ways, as the density across a fold needs both.
///
/// @param pixel      the receiver's, world units, > 0
/// @param tolerance  factor of the rule's tolerances where light is dim, >= 1
[[nodiscard]] inline unsigned quads_along(const PatchShape& shape, const Tessellation& rule, double pixel,
                                          double tolerance) {
    const double by_bend = std::ceil(std::sqrt(shape.bend / (rule.bend * tolerance * pixel)));
    const double by_density =
        (std::min)(std::ceil(shape.change / (rule.density * tolerance)), std::ceil(shape.longest / pixel));
    const double wanted = (std::max)(by_bend, by_density);
    return wanted < double(rule.max_quads) ? (std::max)(1u, unsigned(wanted)) : rule.max_quads; // NaN: the most
}

} // namespace detail
} // namespace nephroid
