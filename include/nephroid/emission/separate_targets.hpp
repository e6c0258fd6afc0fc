// SPDX-License-Identifier: MIT
/// @file  The targets of one lamp: groups of objects that do not overlap as seen from it, so that lights aimed at
///        one each count no light twice.
#pragma once

#include "nephroid/emission/target_groups.hpp"
#include "nephroid/vector/error.hpp"
#include "nephroid/vector/text.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

namespace nephroid {

namespace detail {
/// Joins groups until no two of them overlap.
///
/// @param overlap  of two groups
/// @param bounds   of two groups that are joined
template <Vector3 V, class Overlap, class Bounds>
[[nodiscard]] std::vector<TargetGroup<V>> joined(std::vector<TargetGroup<V>> groups, const Overlap& overlap,
                                                 const Bounds& bounds) {
    for (std::size_t i = 0; i < groups.size();) {
        std::size_t other = i + 1;
        while (other < groups.size() && !overlap(groups[i], groups[other]))
            ++other;
        if (other == groups.size()) {
            ++i;
            continue;
        }
        groups[i].bounds = bounds(groups[i], groups[other]);
        auto& objects = groups[i].objects;
        objects.insert(objects.end(), groups[other].objects.begin(), groups[other].objects.end());
        groups.erase(groups.begin() + static_cast<std::ptrdiff_t>(other));
        i = 0; // the larger group may overlap earlier ones
    }
    return groups;
}

/// The angle between two unit vectors, radians.
template <Vector3 V>
[[nodiscard]] scalar_t<V> angle_between(const V& a, const V& b) {
    return scalar_t<V>(2) * std::atan2(length(V(a - b)), length(V(a + b)));
}

/// The bounds of two groups.
template <Vector3 V>
[[nodiscard]] BoundingSphere<V> bounds_of_both(const std::vector<BoundingSphere<V>>& objects, const TargetGroup<V>& a,
                                               const TargetGroup<V>& b) {
    std::vector<std::size_t> both = a.objects;
    both.insert(both.end(), b.objects.begin(), b.objects.end());
    return sphere_around(objects, both);
}
} // namespace detail

/// The targets of a point or spot light. No direction leads to two of them, so that lights that are aimed at one each
/// count no direction twice. Groups that overlap as seen from the lamp become one target, whose bounds then contain the
/// cones towards its objects, but not all of the objects.
///
/// @param lamp       its position, finite
/// @param groups     as `group_targets` makes them
/// @param cos_outer  cosine of a spot's outer angle, in [-1, 1]; -1 for other lamps. A spot whose target is wider than
///                   its own cone shines into all of that cone
/// Throws std::invalid_argument for a position or a cosine out of its range.
template <Vector3 V>
    requires std::floating_point<scalar_t<V>>
[[nodiscard]] std::vector<TargetGroup<V>> targets_from(const std::type_identity_t<V>& lamp,
                                                       std::vector<TargetGroup<V>> groups,
                                                       scalar_t<V> cos_outer = scalar_t<V>(-1)) {
    using T = scalar_t<V>;
    // In epsilons: `cone_towards` lowers the squared cosine by 12, which near the widest angle below widens each of two
    // cones by about 200, and rounding by about 50.
    constexpr T margin = T(640) * std::numeric_limits<T>::epsilon();
    if (!all_finite(lamp))
        invalid_argument("nephroid::targets_from: the lamp is at " + detail::text_of(lamp) + "; positions are finite");
    if (!(cos_outer >= T(-1) && cos_outer <= T(1)))
        invalid_argument("nephroid::targets_from: cos_outer is " + detail::text_of(cos_outer) +
                         "; pass the cosine of the spot's outer angle, or -1 for a lamp that is no spot");
    struct View {
        V axis;
        T distance, half_angle;
    };
    const T widest = (std::min)(std::acos(cos_outer), T(0.49) * pi<T>); // a wider target counts as every direction
    const auto view = [&](const TargetGroup<V>& group) -> View {
        const V towards = group.bounds.centre - lamp;
        const T distance = length(towards);
        return distance > group.bounds.radius
                   ? View{T(1) / distance * towards, distance, std::asin(group.bounds.radius / distance)}
                   : View{towards, distance, pi<T>};
    };
    const auto overlap = [&](const TargetGroup<V>& a, const TargetGroup<V>& b) {
        const View first = view(a), second = view(b);
        return (std::max)(first.half_angle, second.half_angle) >= widest ||
               detail::angle_between(first.axis, second.axis) <= first.half_angle + second.half_angle + margin;
    };
    const auto bounds = [&](const TargetGroup<V>& a, const TargetGroup<V>& b) -> BoundingSphere<V> {
        View wide = view(a), narrow = view(b);
        if (wide.half_angle < narrow.half_angle)
            std::swap(wide, narrow);
        const T distance = (std::max)(wide.distance, narrow.distance),
                apart = wide.half_angle < widest ? detail::angle_between(wide.axis, narrow.axis) : T(0);
        const T half_angle =
            (std::max)(wide.half_angle, T(0.5) * (wide.half_angle + apart + narrow.half_angle)) + margin;
        if (half_angle >= widest) // every direction, or all of the spot's
            return {lamp, (std::max)(distance, T(1))};
        // Between both axes, such that both cones touch the new one.
        const T turn = half_angle - margin - wide.half_angle;
        const V across = narrow.axis - dot(narrow.axis, wide.axis) * wide.axis;
        const T away = length(across); // 0 if one target is behind the other; rounding may still make `turn` positive
        const V axis =
            turn > T(0) && away > T(0) ? V(std::cos(turn) * wide.axis + std::sin(turn) / away * across) : wide.axis;
        return {lamp + distance * axis, distance * std::sin(half_angle)};
    };
    return detail::joined(std::move(groups), overlap, bounds);
}

/// The targets of an area light, see `targets_from`: no direction from any of its points leads to two of them.
///
/// @param lamp  a sphere around the light, finite, radius >= 0; otherwise std::invalid_argument
template <Vector3 V>
    requires std::floating_point<scalar_t<V>>
[[nodiscard]] std::vector<TargetGroup<V>> targets_from_area(const std::vector<BoundingSphere<V>>& objects,
                                                            const BoundingSphere<V>& lamp,
                                                            std::vector<TargetGroup<V>> groups) {
    using T = scalar_t<V>;
    constexpr T margin = T(256) * std::numeric_limits<T>::epsilon(); // cones are rounded up, two by 25 epsilon each
    constexpr T widest = T(1); // radians: below π/3, the half angle up to which AreaEmission aims at a target
    if (!all_finite(lamp.centre) || !(lamp.radius >= T(0)) || !isfinite(lamp.radius))
        invalid_argument("nephroid::targets_from_area: the lamp's sphere is at " + detail::text_of(lamp.centre) +
                         " with radius " + detail::text_of(lamp.radius) +
                         "; pass a finite sphere around the light, of radius >= 0");
    /// Of the cone that contains all directions from the lamp to the group.
    const auto half_angle = [&](const TargetGroup<V>& group) {
        const T distance = length(V(group.bounds.centre - lamp.centre));
        return distance - lamp.radius > group.bounds.radius
                   ? std::asin((std::min)(T(1), lamp.radius / distance)) +
                         std::asin(group.bounds.radius / (distance - lamp.radius))
                   : pi<T>;
    };
    const auto overlap = [&](const TargetGroup<V>& a, const TargetGroup<V>& b) {
        const T first = half_angle(a), second = half_angle(b);
        if ((std::max)(first, second) >= widest)
            return true;
        return detail::angle_between(normalize(V(a.bounds.centre - lamp.centre)),
                                     normalize(V(b.bounds.centre - lamp.centre))) <= first + second + margin;
    };
    const auto bounds = [&](const TargetGroup<V>& a, const TargetGroup<V>& b) {
        return detail::bounds_of_both(objects, a, b);
    };
    return detail::joined(std::move(groups), overlap, bounds);
}

/// The targets of a beam: patches over them do not overlap, be they disks or the rectangles of `smallest_beam_over`, so
/// that no light is counted twice.
///
/// @param direction  of the beam, unit; otherwise std::invalid_argument
template <Vector3 V>
    requires std::floating_point<scalar_t<V>>
[[nodiscard]] std::vector<TargetGroup<V>> targets_across(const std::vector<BoundingSphere<V>>& objects,
                                                         const std::type_identity_t<V>& direction,
                                                         std::vector<TargetGroup<V>> groups) {
    using T = scalar_t<V>;
    if (!(abs(length2(direction) - T(1)) <= T(1) / T(256)))
        invalid_argument("nephroid::targets_across: the direction is " + detail::text_of(direction) +
                         "; pass one of unit length");
    const auto overlap = [&](const TargetGroup<V>& a, const TargetGroup<V>& b) {
        const V apart = b.bounds.centre - a.bounds.centre;
        const V across = apart - dot(apart, direction) * direction;
        // The smallest rectangle around what is in a disk lies within sqrt(2) of the disk's radius.
        return length(across) <= T(1.4143) * (a.bounds.radius + b.bounds.radius);
    };
    const auto bounds = [&](const TargetGroup<V>& a, const TargetGroup<V>& b) {
        return detail::bounds_of_both(objects, a, b);
    };
    return detail::joined(std::move(groups), overlap, bounds);
}

} // namespace nephroid
