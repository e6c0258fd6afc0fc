// SPDX-License-Identifier: MIT
/// @file  Which leaves of a receiver a flight's beam may reach.
#pragma once

#include "nephroid/ray/ray_splat.hpp"
#include "nephroid/splat/splat_reach.hpp"
#include "nephroid/tree/convex_volume.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace nephroid {

/// The volume in which a flight may light vertices that face it, for a search of a receiver's tree.
template <Vector3 V, Flux F>
[[nodiscard]] auto volume_of(const RaySplat<V, F>& ray) {
    const V& o = ray.beam.origin;
    const V& d = ray.beam.direction;
    return Facing{
        frustum_about(V(o + ray.depth[0] * d), V(o + ray.depth[1] * d), ray.outer_radius[0], ray.outer_radius[1]),
        detail::components(V(-d))};
}

namespace detail {
/// Calls visit(leaf, meeting) for the leaves that a flight's beam may reach. `checks_height` says whether some vertices
/// may lie behind the flight's end.
template <Vector3 V, Flux F, class Takes, class Visit>
void for_each_reached_leaf(const EyePathMap<V>& map, const RaySplat<V, F>& ray, const Takes& takes,
                           const Visit& visit) {
    using T = scalar_t<V>;
    const V& d = ray.beam.direction;
    const T span = ray.depth[1] - ray.depth[0];
    const T slope = span > T(0) ? (ray.outer_radius[1] - ray.outer_radius[0]) / span : T(0);
    const T widest = (std::max)(ray.outer_radius[0], ray.outer_radius[1]);
    map.visit_leaves(volume_of(ray), [&](std::uint32_t number) {
        if (!takes(number))
            return;
        const EyePathLeaf<T>& leaf = map.leaf(number);
        const V half = make_vector<V>(leaf.half[0], leaf.half[1], leaf.half[2]);
        const V middle = make_vector<V>(leaf.middle[0], leaf.middle[1], leaf.middle[2]) - ray.beam.origin;
        // A ball about the leaf against the beam at its furthest depth.
        const T ball = length(half) + ray.rounding, depth = dot(middle, d);
        const T furthest = std::clamp(depth + (slope > T(0) ? ball : -ball), ray.depth[0], ray.depth[1]);
        const T radius = (std::min)(widest, ray.outer_radius[0] + slope * (furthest - ray.depth[0])) + ball;
        const V across = middle - depth * d;
        if (length2(across) > square(radius) * (T(1) + T(64) * std::numeric_limits<T>::epsilon()))
            return;
        visit(number, LeafMeeting{true, depth + ball > ray.distance, true});
    });
}
} // namespace detail

} // namespace nephroid
