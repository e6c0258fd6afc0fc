// SPDX-License-Identifier: MIT
/// @file  Projections that read a renderer's own vertices; an error in words says what is wrong with one.
#pragma once

#include "nephroid/receiver/pixel_footprint.hpp"
#include "nephroid/tree/element_at.hpp"

#include <concepts>
#include <functional>
#include <ranges>

namespace nephroid {

/// Stands for a projection to pixel footprints if they are unknown: each is then a square of the vertices' spacing, in
/// an arbitrary rotation.
struct FootprintsFromSpacing {};

namespace detail {
template <class Vertices, class Projection>
concept CanProject = std::invocable<Projection&, std::ranges::range_reference_t<const Vertices>>;

template <class Vertices, class Projection, class Result>
concept ProjectsTo = CanProject<Vertices, Projection> &&
    std::convertible_to<std::invoke_result_t<Projection&, std::ranges::range_reference_t<const Vertices>>, Result>;

/// Pixel footprints are given by a projection, as a range with one for each vertex, or not at all.
template <class Vertices, class Footprint, class V>
concept GivesFootprints = std::same_as<Footprint, FootprintsFromSpacing> ||
    ProjectsTo<Vertices, const Footprint, PixelFootprint<V>> ||
    (std::ranges::random_access_range<const Footprint>&&
         std::convertible_to<std::ranges::range_reference_t<const Footprint>, PixelFootprint<V>>);

template <class V, class Vertices, class Position, class Normal, class Footprint>
consteval bool explain_projections() {
    static_assert(ProjectsTo<Vertices, Position, V>,
                  "nephroid::EyePathMap: the position projection cannot be called with a vertex, or does not return "
                  "the map's vector (receiver/eye_path_map.hpp)");
    static_assert(ProjectsTo<Vertices, Normal, V>,
                  "nephroid::EyePathMap: the normal projection cannot be called with a vertex, or does not return a "
                  "vector of the positions' type (receiver/eye_path_map.hpp)");
    static_assert(GivesFootprints<Vertices, Footprint, V>,
                  "nephroid::EyePathMap: the footprint projection must return a PixelFootprint of the positions' "
                  "vector for a vertex, or be a range of them (receiver/pixel_footprint.hpp)");
    return false;
}

template <class Footprint, class V, class Vertices, class Position, class Normal>
concept MustProject = (ProjectsTo<Vertices, Position, V> && ProjectsTo<Vertices, Normal, V> &&
                       GivesFootprints<Vertices, Footprint, V>) ||
                      explain_projections<V, Vertices, Position, Normal, Footprint>();

/// What a position projection returns.
template <class Vertices, class Position>
struct ProjectedVector {
    static_assert(CanProject<Vertices, Position>,
                  "nephroid: the position projection cannot be called with a vertex (receiver/eye_path_map.hpp)");
    using type = std::remove_cvref_t<std::invoke_result_t<Position&, std::ranges::range_reference_t<const Vertices>>>;
    static_assert(!std::is_arithmetic_v<type>,
                  "nephroid: the position projection returns a number instead of a vector");
};

/// @param footprint  a projection of the vertices, or a range with one for each
template <class Vertices, class Footprint>
[[nodiscard]] auto footprint_of(const Vertices& vertices, const Footprint& footprint, std::size_t i) {
    if constexpr (std::ranges::range<const Footprint>)
        return element_at(footprint, i);
    else
        return std::invoke(footprint, element_at(vertices, i));
}
} // namespace detail

} // namespace nephroid
