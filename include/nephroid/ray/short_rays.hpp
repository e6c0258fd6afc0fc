// SPDX-License-Identifier: MIT
/// @file  Short rays: whether the light that a flight stands for can have come to a vertex beside the flight.
#pragma once

#include "nephroid/ray/ray_splat.hpp"
#include "nephroid/transport/ray_start.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace nephroid::detail {

/// Clears the weights of the vertices of a leaf from which a ray against the flight meets a surface too soon.
///
/// @return  how many it cleared
template <class S, Vector3 V, Flux F>
[[nodiscard]] std::uint64_t keep_visible(const S& scene, const RaySplat<V, F>& ray, std::uint32_t leaf,
                                         const EyePathMap<V>& map, const ShortRays& policy,
                                         std::array<scalar_t<V>, PointTree<V>::leaf_size>& weight) {
    using T = scalar_t<V>;
    std::uint64_t rejected = 0;
    const TreeLeaf at = map.tree().leaves()[leaf];
    const V back = -ray.beam.direction, origin = map.tree().origin();
    const T leaving = dot(ray.origin_normal, ray.beam.direction);
    for (std::size_t i = 0; i < at.size; ++i) {
        if (!(weight[i] > T(0)))
            continue;
        const std::size_t slot = at.first + i;
        const V place = make_vector<V>(map.tree().x()[slot], map.tree().y()[slot], map.tree().z()[slot]);
        const V normal = make_vector<V>(map.normal_x()[slot], map.normal_y()[slot], map.normal_z()[slot]);
        const V from_start = place - ray.beam.origin;
        const T facing = dot(normal, back), depth = dot(from_start, ray.beam.direction);
        const V position = origin + place;
        const T lift = T(64) * std::numeric_limits<T>::epsilon() * (largest_component(position) + map.diagonal());
        // Not as far as the surface that the flight left, nor the lamp.
        const T way = leaving > T(0) ? dot(from_start, ray.origin_normal) / leaving : depth;
        const T radius = ray.beam.largest_radius(depth);
        const T reach =
            (std::min)(T(policy.radii) * radius / (std::max)(facing, T(0.25)), T(0.999) * way - T(2) * lift);
        if (!(reach > T(0)))
            continue;
        // Further back by what the tracer skips.
        const T skipped = skipped_by_tracer<V>(scene);
        const V start = position + lift * normal - skipped * back;
        if (scene.intersect(start, back, skipped, reach + skipped)) {
            weight[i] = T(0);
            ++rejected;
        }
    }
    return rejected;
}

} // namespace nephroid::detail
