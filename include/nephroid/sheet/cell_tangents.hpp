// SPDX-License-Identifier: MIT
/// @file  How a photon's place changes over a cell, from its neighbours on the same sheet.
#pragma once

#include "nephroid/sheet/node_lattice.hpp"

#include <cmath>

namespace nephroid::detail {

/// The change of place over one step along an axis of the lattice, world units. With neighbours on the sheet on both
/// sides it is the central difference; with two on one side, the one-sided (−3 x₀ + 4 x₁ − x₂)/2; with one
/// alone, the step to it; with none, zero.
///
/// If the changes on the two sides differ by more than four times and by more than two pixels, there is a crease that
/// the normals do not show, and the shorter change is taken.
///
/// @param known   known(place) -> NodeEnds: nodes that have been traced
/// @param pixel   pixel() -> world units
template <Vector3 V, Flux F, class Known, class Pixel>
[[nodiscard]] Double3 change_along(const NodeEnd<V, F>& node, const LatticePlace& place, const LatticePlace& step,
                                   const Known& known, const Pixel& pixel) {
    const auto neighbour = [&](const NodeEnd<V, F>& from, const LatticePlace& at) {
        const NodeEnd<V, F>* const found = end_of<V, F>(known(at), node.signature);
        return found && are_joined(from, *found, pixel) ? found : nullptr;
    };
    const NodeEnd<V, F>* const before = neighbour(node, place - step);
    const NodeEnd<V, F>* const after = neighbour(node, place + step);
    const auto change = [&](const NodeEnd<V, F>& from, const NodeEnd<V, F>& to) {
        return double3(V(to.position - from.position));
    };
    if (before && after) {
        const Double3 left = change(*before, node), right = change(node, *after);
        const double left2 = length2(left), right2 = length2(right);
        if ((left2 > 16 * right2 || right2 > 16 * left2) && length2(right - left) > 4 * square(double(pixel())))
            return left2 < right2 ? left : right;
        return 0.5 * (left + right);
    }
    if (!before && !after)
        return {};
    const NodeEnd<V, F>& first = before ? *before : *after;
    const double sign = before ? -1 : 1;
    const Double3 near_change = sign * change(node, first);
    const LatticePlace next = before ? place - 2 * step : place + 2 * step;
    if (const NodeEnd<V, F>* const second = neighbour(first, next))
        return 1.5 * near_change - (0.5 * sign) * change(first, *second);
    return near_change;
}

} // namespace nephroid::detail
