// SPDX-License-Identifier: MIT
/// @file  The concept of a raster chart: where on a raster of texels a point of the scene lies.
#pragma once

#include "nephroid/vector/double3.hpp"

#include <cmath>
#include <concepts>
#include <cstddef>
#include <optional>

namespace nephroid {

/// A vector in double precision, as charts take and return it.
using ChartVector = detail::Double3;

/// Where a point lies on a raster. Texel (i, j) is i <= x < i + 1, j <= y < j + 1.
struct RasterPlace {
    double x = 0, y = 0;
    ChartVector x_gradient, y_gradient; ///< how x and y change with the point, texels per world unit
    double depth = 0;                   ///< grows away from who looks, world units

    /// The area on the raster of a unit area of a surface with this normal there.
    [[nodiscard]] double area_scale(const ChartVector& normal) const {
        return std::abs(dot(normal, detail::plain_cross(x_gradient, y_gradient)));
    }
    /// The largest that it is for any normal.
    [[nodiscard]] double largest_area_scale() const { return length(detail::plain_cross(x_gradient, y_gradient)); }
};

/// A line of sight through a raster.
struct RasterRay {
    ChartVector origin, direction; ///< direction: unit
};

/// A chart of receivers: `columns()` × `rows()` texels, `place(x)` says where a point lies or nothing if it is not
/// ahead of who looks, `ray(x, y)` looks through a point of the raster. Straight lines must stay straight. `repeats()`,
/// optional: the raster is a tile of a pattern without end.
template <class C>
concept RasterChart = requires(const C chart, const ChartVector& x, double at) {
    { chart.columns() } -> std::convertible_to<std::size_t>;
    { chart.rows() } -> std::convertible_to<std::size_t>;
    { chart.place(x) } -> std::same_as<std::optional<RasterPlace>>;
    { chart.ray(at, at) } -> std::same_as<RasterRay>;
};

namespace detail {
template <class C>
consteval bool explain_chart() {
    static_assert(RasterChart<C>, "nephroid: the chart lacks columns(), rows(), place(x) -> optional<RasterPlace> or "
                                  "ray(x, y) -> RasterRay (image/raster_chart.hpp)");
    return false;
}
template <class C>
concept MustBeChart = RasterChart<C> || explain_chart<C>();

template <class C>
[[nodiscard]] bool repeats(const C& chart) {
    if constexpr (requires { chart.repeats(); })
        return chart.repeats();
    else
        return false;
}

/// How far apart in the scene two points of the raster are; charts that repeat look along one direction.
template <class C>
[[nodiscard]] ChartVector step_between_tiles(const C& chart, double columns, double rows) {
    if (columns == 0 && rows == 0)
        return {};
    return chart.ray(columns, rows).origin - chart.ray(0, 0).origin;
}

/// The chart says that its lines of sight do not begin on the receiver.
template <class C>
concept LooksFromAfar = requires {
    requires !bool(C::lies_on_receiver);
};
} // namespace detail

} // namespace nephroid
