// SPDX-License-Identifier: MIT
/// @file  Several targets for one lamp: groups of objects that are far apart, so that no photons fly between them.
#pragma once

#include "nephroid/emission/target.hpp"

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace nephroid {

/// Objects that a light is aimed at together.
template <Vector3 V>
struct TargetGroup {
    std::vector<std::size_t> objects; ///< indices in the array that was given to `group_targets`
    BoundingSphere<V> bounds;         ///< what a light is aimed at to reach them
};

namespace detail {
/// A sphere that contains some of the spheres. Its centre is the centre of their box.
template <Vector3 V>
[[nodiscard]] BoundingSphere<V> sphere_around(const std::vector<BoundingSphere<V>>& spheres,
                                              const std::vector<std::size_t>& which) {
    using T = scalar_t<V>;
    using t = vector_traits<V>;
    constexpr T most = (std::numeric_limits<T>::max)();
    std::array<T, 3> low{most, most, most}, high{-most, -most, -most};
    for (const std::size_t i : which) {
        const std::array<T, 3> centre{t::x(spheres[i].centre), t::y(spheres[i].centre), t::z(spheres[i].centre)};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            low[axis] = (std::min)(low[axis], centre[axis] - spheres[i].radius);
            high[axis] = (std::max)(high[axis], centre[axis] + spheres[i].radius);
        }
    }
    const auto middle = [&](std::size_t axis) { return low[axis] + T(0.5) * (high[axis] - low[axis]); };
    const V centre = t::make(middle(0), middle(1), middle(2));
    T radius = T(0);
    for (const std::size_t i : which)
        radius = (std::max)(radius, length(V(spheres[i].centre - centre)) + spheres[i].radius);
    return {centre, radius * (T(1) + T(8) * std::numeric_limits<T>::epsilon())};
}

/// Divides objects at the gap between them, across one axis, that is the widest and leaves the most on both sides.
///
/// @return  the order of the objects and how many of them lie on the first side; nothing if there is no gap
template <Vector3 V>
[[nodiscard]] std::optional<std::pair<std::vector<std::size_t>, std::size_t>>
widest_gap(const std::vector<BoundingSphere<V>>& spheres, const std::vector<std::size_t>& which) {
    using T = scalar_t<V>;
    using t = vector_traits<V>;
    std::optional<std::pair<std::vector<std::size_t>, std::size_t>> best;
    T best_score = T(0);
    for (int axis = 0; axis < 3; ++axis) {
        const auto low = [&](std::size_t i) {
            const V& c = spheres[i].centre;
            return (axis == 0 ? t::x(c) : axis == 1 ? t::y(c) : t::z(c)) - spheres[i].radius;
        };
        std::vector<std::size_t> order = which;
        std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return low(a) < low(b); });
        T end = std::numeric_limits<T>::lowest();
        for (const std::size_t i : order)
            end = (std::max)(end, low(i) + T(2) * spheres[i].radius);
        const T begin = low(order.front());
        T reached = begin;
        std::size_t split = 0;
        T axis_score = T(0);
        for (std::size_t n = 0; n < order.size(); ++n) {
            const T next = low(order[n]);
            const T score = (next - reached) * (std::min)(reached - begin, end - next);
            if (n > 0 && next > reached && score > axis_score)
                axis_score = score, split = n;
            reached = (std::max)(reached, next + T(2) * spheres[order[n]].radius);
        }
        if (axis_score > best_score) {
            best_score = axis_score;
            best.emplace(std::move(order), split);
        }
    }
    return best;
}

/// Divides a group further wherever that makes the targets smaller, to at most 2^depth groups.
template <Vector3 V>
void divide(const std::vector<BoundingSphere<V>>& objects, TargetGroup<V> group, int depth,
            std::vector<TargetGroup<V>>& groups) {
    using T = scalar_t<V>;
    constexpr T worth_it = T(0.7); // largest ratio of the parts' area to the whole's that is worth one more light
    const auto gap = depth > 0 ? widest_gap(objects, group.objects) : std::nullopt;
    if (gap) {
        const auto middle = gap->first.begin() + static_cast<std::ptrdiff_t>(gap->second);
        const std::vector<std::size_t> first(gap->first.begin(), middle), second(middle, gap->first.end());
        std::vector<TargetGroup<V>> parts;
        divide(objects, {first, sphere_around(objects, first)}, depth - 1, parts);
        divide(objects, {second, sphere_around(objects, second)}, depth - 1, parts);
        T area = T(0);
        for (const TargetGroup<V>& part : parts)
            area = area + square(part.bounds.radius);
        if (area <= worth_it * square(group.bounds.radius)) {
            std::move(parts.begin(), parts.end(), std::back_inserter(groups));
            return;
        }
    }
    groups.push_back(std::move(group));
}
} // namespace detail

/// Divides objects into at most 64 groups that are far apart. A light for each group sends fewer photons past the
/// objects than one light for all. Choose each lamp's targets from the groups by `targets_from`, `targets_from_area` or
/// `targets_across` (emission/separate_targets.hpp): seen from a lamp, groups may overlap.
///
/// ```cpp
/// std::vector<nephroid::PointLight<Vec3, Colour>> lights; // of one lamp; a LightSet takes them
/// for (const auto& target : nephroid::targets_from(position, nephroid::group_targets(objects)))
///     lights.push_back(nephroid::PointLight<Vec3, Colour>(
///         {.position = position, .intensity = intensity, .target = target.bounds}));
/// ```
///
/// @param objects  a sphere around each specular object, or around each triangle; finite, at least one. Otherwise
///                 std::invalid_argument. Spheres of objects are better than spheres of their boxes, which are up to
///                 sqrt(3) times as wide
template <Vector3 V>
    requires std::floating_point<scalar_t<V>>
[[nodiscard]] std::vector<TargetGroup<V>> group_targets(const std::vector<BoundingSphere<V>>& objects) {
    if (objects.empty())
        invalid_argument("nephroid::group_targets: no objects; pass the bounds of at least one");
    for (const BoundingSphere<V>& object : objects)
        if (!all_finite(object.centre) || !(object.radius >= 0) || !isfinite(object.radius))
            invalid_argument("nephroid::group_targets: an object's bounds are not finite, or its radius is negative");
    std::vector<std::size_t> all(objects.size());
    std::iota(all.begin(), all.end(), std::size_t(0));
    const BoundingSphere<V> bounds = detail::sphere_around(objects, all);
    std::vector<TargetGroup<V>> groups;
    detail::divide(objects, {std::move(all), bounds}, 6, groups);
    return groups;
}

} // namespace nephroid
