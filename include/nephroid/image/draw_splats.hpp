// SPDX-License-Identifier: MIT
/// @file  Draws photons onto a caustic map as ellipses: their footprints, projected onto the chart.
///
/// Derivation: include/nephroid/README.md, "Photons on a grid".
#pragma once

#include "nephroid/execution/checked_executor.hpp"
#include "nephroid/footprint/kernel.hpp"
#include "nephroid/image/caustic_map.hpp"
#include "nephroid/image/raster_tiles.hpp"
#include "nephroid/splat/splat_photons.hpp"
#include "nephroid/vector/error.hpp"
#include "nephroid/vector/text.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace nephroid {

namespace detail {

/// A photon's footprint on the raster: within |M (x − centre)|² < 1.
struct RasterEllipse {
    ChartVector position, normal;
    double x = 0, y = 0;           ///< of the centre, texels
    double xx = 0, xy = 0, yy = 0; ///< MᵀM
    double peak = 0;               ///< irradiance of a unit of flux where the kernel is 1
    double sag = 0;                ///< how far from its plane a texel may lie, world units
    RasterBox box;
};

/// The ellipse of a photon, or nothing: a number is not finite, or it lies where the chart does not see it.
/// @param kernel_width  of the pixel filter, texels: its disk is added to the footprint
template <Vector3 V, Flux F, std::size_t N, class C>
[[nodiscard]] std::optional<RasterEllipse> raster_ellipse(const Deposit<V, F, N>& deposit, double smoothing,
                                                          double filter_width, const C& chart) {
    const ChartVector position = double3(deposit.position), normal = double3(deposit.normal);
    const auto place = chart.place(position);
    if (!place)
        return std::nullopt;
    const double scale = place->area_scale(normal);
    if (!(scale >= 1e-3 * place->largest_area_scale()))
        return std::nullopt;
    const ChartVector a = (0.5 * smoothing) * double3(deposit.d_position[0]),
                      b = (0.5 * smoothing) * double3(deposit.d_position[1]);
    const double ax = dot(place->x_gradient, a), ay = dot(place->y_gradient, a), bx = dot(place->x_gradient, b),
                 by = dot(place->y_gradient, b);
    // C' = G C Gᵀ, and the filter's disk.
    const double xx = ax * ax + bx * bx + square(filter_width), yy = ay * ay + by * by + square(filter_width),
                 xy = ax * ay + bx * by, determinant = xx * yy - xy * xy;
    if (!(determinant > 0) || !std::isfinite(determinant) || !std::isfinite(place->x + place->y))
        return std::nullopt;
    RasterEllipse e;
    e.position = position, e.normal = normal, e.x = place->x, e.y = place->y;
    e.xx = yy / determinant, e.yy = xx / determinant, e.xy = -xy / determinant;
    e.peak = scale / std::sqrt(determinant);
    e.sag = 0.25 * (std::min)(length(a), length(b));
    e.box = {place->x - std::sqrt(xx) - 0.5, place->y - std::sqrt(yy) - 0.5, place->x + std::sqrt(xx) - 0.5,
             place->y + std::sqrt(yy) - 0.5};
    return e;
}

/// Adds an ellipse to the texels of a window.
/// @return  whether any texel got light
template <class Map, class F, class K>
bool add_ellipse(const RasterEllipse& e, const F& flux, const K& kernel, const RasterWindow& window, Map& map) {
    bool arrived = false;
    const ChartVector position = e.position + step_between_tiles(map.chart(), window.shift_x, window.shift_y);
    for (std::size_t j = window.row; j < window.row + window.rows; ++j) {
        const double y = double(j) + 0.5 - (e.y + window.shift_y);
        for (std::size_t i = window.column; i < window.column + window.columns; ++i) {
            const double x = double(i) + 0.5 - (e.x + window.shift_x);
            const double radius2 = e.xx * x * x + 2 * e.xy * x * y + e.yy * y * y;
            if (!(radius2 < 1))
                continue;
            auto& texel = map.texel(i, j);
            if (!(texel.scale > 0) || !Map::is_on(texel, position, e.normal, e.sag))
                continue;
            texel.irradiance = texel.irradiance + flux * typename Map::T(e.peak * kernel(radius2));
            arrived = true;
        }
    }
    return arrived;
}
} // namespace detail

/// How photons are drawn onto a map.
struct MapSplatting {
    double smoothing = 2.5;  ///< factor of the tangents, > 0
    double filter_width = 1; ///< of the pixel filter, in units of the one with a texel's variance; 0: none
};

/// Draws photons onto a map as ellipses.
///
/// @param photons  deposits with two tangents for smoothing 1, as of `neighbour_tangents`
/// @return  what became of them: splatted, unseen (where the map sees nothing, or another surface), or invalid
/// Throws std::invalid_argument for a smoothing or a filter that makes no sense.
template <class Photons, Vector3 V, Flux F, class C, class E = SerialExecutor>
Statistics draw_splats(const Photons& photons, CausticMap<V, F, C>& map, const MapSplatting& how = {},
                       E&& executor = E{}) {
    if (!(how.smoothing > 0) || !std::isfinite(how.smoothing))
        invalid_argument("nephroid::draw_splats: smoothing is " + detail::text_of(how.smoothing) +
                         "; it must be positive and finite");
    if (!(how.filter_width >= 0) || !std::isfinite(how.filter_width))
        invalid_argument("nephroid::draw_splats: filter_width is " + detail::text_of(how.filter_width) +
                         "; it must be finite and not negative");
    detail::CheckedExecutor checked(executor);
    const BiweightKernel kernel;
    const double width = how.filter_width * pixel_filter_width<BiweightKernel>;
    detail::RasterTiles tiles(map.chart().columns(), map.chart().rows(), detail::repeats(map.chart()));
    constexpr std::size_t batch = std::size_t(1) << 16, per_task = 1024;
    std::vector<detail::RasterEllipse> ellipses;
    std::vector<detail::RasterBox> boxes;
    Statistics account;
    for (std::size_t first = 0; first < std::size(photons); first += batch) {
        const std::size_t count = (std::min)(batch, std::size(photons) - first);
        ellipses.assign(count, {});
        boxes.assign(count, {});
        detail::for_each_index(checked, count, per_task, [&](std::size_t i) {
            if (!std::isfinite(double(flux_traits<F>::power(photons[first + i].flux))))
                return;
            if (const auto e = detail::raster_ellipse(photons[first + i], how.smoothing, width, map.chart())) {
                ellipses[i] = *e;
                boxes[i] = e->box;
            }
        });
        const std::vector<char> arrived = tiles.draw(
            boxes,
            [&](std::size_t i, const detail::RasterWindow& window) {
                return detail::add_ellipse(ellipses[i], photons[first + i].flux, kernel, window, map);
            },
            checked);
        for (std::size_t i = 0; i < count; ++i) {
            const auto& photon = photons[first + i];
            const double power = double(flux_traits<F>::power(photon.flux));
            const bool is_valid = std::isfinite(power) && all_finite(photon.position) &&
                                  all_finite(photon.d_position[0]) && all_finite(photon.d_position[1]);
            account.end(arrived[i] ? Fate::splatted
                        : is_valid ? Fate::unseen
                                   : Fate::invalid,
                        std::isfinite(power) ? power : 0);
        }
    }
    return account;
}

} // namespace nephroid
