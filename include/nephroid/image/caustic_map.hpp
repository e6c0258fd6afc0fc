// SPDX-License-Identifier: MIT
/// @file  A caustic map: a raster of irradiance on the surfaces that a chart sees, for renderers that light with a
///        texture.
///
/// ```cpp
/// nephroid::CausticMap<Vec3, Colour, nephroid::PlaneChart> map(nephroid::PlaneChart(corner, u, v, 1024, 1024));
/// nephroid::draw_sheets(buffer, map, {}, threads);
/// const Colour irradiance = map.at(x, n);
/// ```
#pragma once

#include "nephroid/emission/flux.hpp"
#include "nephroid/image/raster_chart.hpp"

#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace nephroid {

/// A point of a surface that receives light.
struct ReceiverPoint {
    ChartVector position, normal; ///< normal: unit, on the side of the light
};

/// Irradiance by texel, with the surface that each texel sees: light on other surfaces is left out, as by a shadow map
/// [Williams 1978].
template <Vector3 V, Flux F, class C>
    requires detail::MustBeChart<C>
class CausticMap {
public:
    using T = scalar_t<V>;
    using chart_type = C;

    struct Texel {
        F irradiance;            ///< flux per area of the surface
        ReceiverPoint surface{}; ///< in the middle of the texel; without a normal if there is none
        float scale = 0;         ///< texels per unit area of the surface; 0 where it is seen edge-on
        float depth = 0;         ///< of the chart

        [[nodiscard]] double side() const { return 1 / std::sqrt(double(scale)); }
    };

    /// The map of a chart that lies on its receiver, such as PlaneChart. Light comes against the direction of sight's
    /// side: normals face who looks.
    explicit CausticMap(C chart) requires(!detail::LooksFromAfar<C>)
        : CausticMap(std::move(chart), [](const RasterRay& ray) {
              return std::optional<ReceiverPoint>({ray.origin, -1.0 * ray.direction});
          }) {}

    /// @param see  see(ray) -> optional<ReceiverPoint>: the receiver along a line of sight (image/see_receiver.hpp)
    template <class See>
    CausticMap(C chart, const See& see)
        : chart_(std::move(chart)), texels_(chart_.columns() * chart_.rows(), Texel{flux_traits<F>::zero()}) {
        for (std::size_t j = 0; j < chart_.rows(); ++j)
            for (std::size_t i = 0; i < chart_.columns(); ++i)
                if (const auto point = see(chart_.ray(double(i) + 0.5, double(j) + 0.5)))
                    set_surface(texels_[j * chart_.columns() + i], *point);
    }

    [[nodiscard]] const C& chart() const { return chart_; }
    [[nodiscard]] Texel& texel(std::size_t i, std::size_t j) { return texels_[j * chart_.columns() + i]; }
    [[nodiscard]] const Texel& texel(std::size_t i, std::size_t j) const { return texels_[j * chart_.columns() + i]; }

    /// Whether light at a point with a normal falls on what a texel sees.
    ///
    /// @param sag  how far the surface may leave its tangent plane between the two, world units
    [[nodiscard]] static bool is_on(const Texel& texel, const ChartVector& x, const ChartVector& normal, double sag) {
        if (!(texel.scale > 0) || !(dot(texel.surface.normal, normal) > 0.2))
            return false;
        // At most half of the texel's side, 1/√scale, without the root: this is asked for each texel of each patch.
        const double beyond = std::abs(dot(normal, texel.surface.position - x)) - sag;
        return beyond <= 0 || 4 * beyond * beyond * double(texel.scale) <= 1;
    }

    /// The irradiance at a point of a surface: between the four nearest texels that see this surface, linearly. Zero
    /// where none does.
    [[nodiscard]] F at(const V& x, const V& normal) const {
        F sum = flux_traits<F>::zero();
        const ChartVector point = detail::double3(x), n = detail::double3(normal);
        const auto place = chart_.place(point);
        if (!place || !std::isfinite(place->x) || !std::isfinite(place->y))
            return sum;
        const double left = std::floor(place->x - 0.5), low = std::floor(place->y - 0.5);
        double weights = 0;
        for (int k = 0; k < 4; ++k) {
            const double i = left + (k & 1), j = low + (k >> 1);
            const double weight = (1 - std::abs(place->x - 0.5 - i)) * (1 - std::abs(place->y - 0.5 - j));
            const double tile_i = columns_from_first_tile(i), tile_j = rows_from_first_tile(j);
            const Texel* const one = find(i - tile_i, j - tile_j);
            if (!one || !is_on(*one, point + detail::step_between_tiles(chart_, -tile_i, -tile_j), n, one->side()))
                continue;
            sum = sum + one->irradiance * T(weight);
            weights += weight;
        }
        return weights > 0 ? static_cast<F>(sum * T(1 / weights)) : sum;
    }

    /// The flux on the map: of each texel the irradiance times the area of the surface that it sees.
    [[nodiscard]] double flux() const {
        double sum = 0;
        for (const Texel& texel : texels_)
            if (texel.scale > 0)
                sum += flux_traits<F>::power(texel.irradiance) / double(texel.scale);
        return sum;
    }

private:
    void set_surface(Texel& texel, const ReceiverPoint& point) const {
        const auto place = chart_.place(point.position);
        if (!place)
            return;
        texel.surface = point;
        texel.depth = float(place->depth);
        const double scale = place->area_scale(point.normal);
        // Edge-on a texel sees more surface than it can tell apart.
        texel.scale = scale >= 1e-3 * place->largest_area_scale() ? float(scale) : 0;
    }

    /// To the tile of a map that repeats.
    [[nodiscard]] double columns_from_first_tile(double i) const {
        const double columns = double(chart_.columns());
        return detail::repeats(chart_) ? columns * std::floor(i / columns) : 0;
    }
    [[nodiscard]] double rows_from_first_tile(double j) const {
        const double rows = double(chart_.rows());
        return detail::repeats(chart_) ? rows * std::floor(j / rows) : 0;
    }

    [[nodiscard]] const Texel* find(double i, double j) const {
        if (!(i >= 0 && j >= 0 && i < double(chart_.columns()) && j < double(chart_.rows())))
            return nullptr;
        return &texel(std::size_t(i), std::size_t(j));
    }

    C chart_;
    std::vector<Texel> texels_;
};

} // namespace nephroid
