// SPDX-License-Identifier: MIT
/// @file  Estimates pixel footprints from the vertices of neighbouring pixels, for renderers that do not know them.
#pragma once

#include "nephroid/receiver/projection.hpp"
#include "nephroid/vector/error.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace nephroid {

namespace detail {
/// The vertices that each pixel of a film sees.
class VerticesByPixel {
public:
    /// @param pixels  of the vertices, each less than `count`
    VerticesByPixel(const std::vector<std::size_t>& pixels, std::size_t count)
        : begin_(count + 1), vertices_(pixels.size()) {
        for (const std::size_t pixel : pixels)
            ++begin_[pixel + 1];
        for (std::size_t i = 0; i < count; ++i)
            begin_[i + 1] += begin_[i];
        std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
        for (std::size_t i = 0; i < pixels.size(); ++i)
            vertices_[next[pixels[i]]++] = i;
    }

    [[nodiscard]] std::size_t begin(std::size_t pixel) const { return begin_[pixel]; }
    [[nodiscard]] std::size_t end(std::size_t pixel) const { return begin_[pixel + 1]; }
    [[nodiscard]] std::size_t operator[](std::size_t i) const { return vertices_[i]; }

private:
    std::vector<std::size_t> begin_, vertices_;
};

/// Whether two vertices may lie on one smooth surface. Across a step in depth, the segment between them leaves both
/// tangent planes on the same side. On a smooth surface it leaves one above and the other below, and hardly leaves the
/// mean of the two planes.
///
/// @param way  from one vertex to the other
template <Vector3 V>
[[nodiscard]] bool are_joined(const V& way, const V& normal, const V& other_normal) {
    using T = scalar_t<V>;
    const T off2 = square(T(0.5) * dot(way, V(normal + other_normal)));
    const T bend2 = length2(V(normal - other_normal));
    return dot(normal, other_normal) > T(0.2) &&
           off2 <= (std::max)(T(0.01), T(0.0625) * bend2) * length2(way); // a slope of 0.1, or a quarter of the bend
}

/// One side of a footprint, from the steps to the vertices of the pixels before and after.
template <Vector3 V>
[[nodiscard]] std::optional<V> side_between(const std::optional<V>& before, const std::optional<V>& after) {
    using T = scalar_t<V>;
    if (!before || !after)
        return before ? before : after;
    // A step that is much longer than the other has crossed an edge that the normals do not show.
    const T before2 = length2(*before), after2 = length2(*after);
    if (before2 > T(9) * after2 || after2 > T(9) * before2)
        return before2 < after2 ? before : after;
    return V(T(0.5) * (*before + *after));
}
} // namespace detail

/// Estimates the footprints of a film's pixels: along each axis of the film, half the step from the vertex of the pixel
/// before to that of the pixel after, projected onto the vertex's tangent plane. Neighbours on other surfaces are left
/// out; normals and steps in depth show them. If only one neighbour along an axis is left, the step to it is used. If
/// none is left, the side is as long as the other one and perpendicular to it. The error is of second order in the
/// pixel's angle; the camera's own rays (`footprint_from_rays`) are exact.
///
/// Eye paths must go through the pixels' centres. A pixel may have several vertices if glass splits its path, but not
/// because of several samples, since these are less than a pixel apart.
///
/// @param vertices       as for EyePathMap
/// @param width, height  of the film, pixels
/// @param pixel          projection to y * width + x
/// @return  one for each vertex, for EyePathMap; both sides are zero (unknown) if no neighbour is on the same surface
/// Throws std::invalid_argument naming a vertex whose pixel is not on the film.
template <std::ranges::random_access_range Vertices, class Pixel, class Position, class Normal>
[[nodiscard]] auto footprints_from_film(const Vertices& vertices, std::size_t width, std::size_t height, Pixel pixel,
                                        Position position, Normal normal) {
    using V = typename detail::ProjectedVector<Vertices, Position>::type;
    using T = scalar_t<V>;
    const std::size_t count = std::size_t(std::ranges::size(vertices));
    std::vector<std::size_t> pixels(count);
    for (std::size_t i = 0; i < count; ++i) {
        pixels[i] = std::size_t(std::invoke(pixel, detail::element_at(vertices, i)));
        if (pixels[i] >= width * height)
            invalid_argument("nephroid::footprints_from_film: vertex " + std::to_string(i) + " is in pixel " +
                             std::to_string(pixels[i]) + " of a film of " + std::to_string(width) + " x " +
                             std::to_string(height) + " pixels; pixels count from 0, row by row");
    }
    const detail::VerticesByPixel by_pixel(pixels, width * height);

    std::vector<PixelFootprint<V>> footprints(count, {zero_vector<V>(), zero_vector<V>()});
    for (std::size_t i = 0; i < count; ++i) {
        const V at = std::invoke(position, detail::element_at(vertices, i));
        const V n = std::invoke(normal, detail::element_at(vertices, i));
        // The step to the nearest of another pixel's vertices that is on the same surface, in the tangent plane.
        const auto way_to = [&](std::size_t neighbour, bool is_on_film) {
            std::optional<V> way;
            if (is_on_film)
                for (std::size_t k = by_pixel.begin(neighbour); k < by_pixel.end(neighbour); ++k) {
                    const auto& other = detail::element_at(vertices, by_pixel[k]);
                    const V there(std::invoke(position, other) - at);
                    if (!detail::are_joined<V>(there, n, std::invoke(normal, other)))
                        continue;
                    const V flat(there - dot(there, n) * n);
                    if (!way || length2(flat) < length2(*way))
                        way = flat;
                }
            return way;
        };
        const auto back = [&](std::optional<V> way) { return way ? std::optional<V>(-*way) : way; };
        const std::size_t x = pixels[i] % width, y = pixels[i] / width;
        const std::optional<V> u = detail::side_between<V>(back(way_to(pixels[i] - 1, x > 0)),
                                                           way_to(pixels[i] + 1, x + 1 < width)),
                               v = detail::side_between<V>(back(way_to(pixels[i] - width, y > 0)),
                                                           way_to(pixels[i] + width, y + 1 < height));
        if (!u && !v)
            continue;
        const PixelFootprint<V> footprint{u ? *u : cross(*v, n), v ? *v : cross(n, *u)};
        if (const T area = length(cross(footprint.u, footprint.v)); area > T(0) && isfinite(T(1) / area))
            footprints[i] = footprint;
    }
    return footprints;
}

} // namespace nephroid
