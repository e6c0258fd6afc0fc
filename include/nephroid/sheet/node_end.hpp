// SPDX-License-Identifier: MIT
/// @file  A photon as a corner of patches of light, and which neighbours lie on one sheet with it.
#pragma once

#include "nephroid/emission/flux.hpp"
#include "nephroid/vector/double3.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

namespace nephroid::detail {

/// Where one of a node's paths ends.
template <Vector3 V, Flux F>
struct NodeEnd {
    V position;              ///< relative to the receiver's origin
    V normal;                ///< of the receiver, on the side that the light came from, unit
    V direction;             ///< of flight, unit
    F density;               ///< flux per area of the chart
    std::uint32_t signature; ///< of its path
};

/// All the ends of the paths that leave a lamp at one point of its chart.
template <Vector3 V, Flux F>
using NodeEnds = std::span<const NodeEnd<V, F>>;

/// The end with this signature, or null.
template <Vector3 V, Flux F>
[[nodiscard]] const NodeEnd<V, F>* end_of(NodeEnds<V, F> ends, std::uint32_t signature) {
    for (const auto& end : ends)
        if (end.signature == signature)
            return &end;
    return nullptr;
}

/// Whether two neighbours lie on one smooth piece of the receiver, from places and normals alone.
///
/// Let d lead from one to the other. At the two ends of an arc d · n has opposite signs, and the sum is of third
/// order; across a step both signs are the same.
///
/// @param pixel  pixel() -> a pixel's side there, world units; called only where it matters
template <Vector3 V, Flux F, class Pixel>
[[nodiscard]] bool are_joined(const NodeEnd<V, F>& a, const NodeEnd<V, F>& b, const Pixel& pixel) {
    using T = scalar_t<V>;
    if (!(dot(a.normal, b.normal) > T(0.2)))
        return false;
    const V d = b.position - a.position;
    const T height = abs(T(dot(d, V(a.normal + b.normal)))) * T(0.5);
    const T height2 = height * height, size2 = length2(d);
    if (height2 <= T(1e-8) * size2 || height2 <= T(1.0 / 16) * size2 * length2(V(a.normal - b.normal)))
        return true;
    return double(height) <= 1e-4 * std::sqrt(double(size2)) + 0.1 * double(pixel());
}

} // namespace nephroid::detail
