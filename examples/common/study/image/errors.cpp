// SPDX-License-Identifier: MIT
/// @file  The table of methods of image-space caustics, each at its best s, against exact pictures.
#include "common/builtin_film.hpp"
#include "common/study/image/command.hpp"
#include "common/study/image/waves.hpp"

#include "nephroid/image/trace_buffer.hpp"
#include "nephroid/quality/error.hpp"
#include "nephroid/quality/exposure.hpp"

#include <cmath>
#include <cstdio>
#include <limits>

namespace nephroid::examples::study::image {

namespace {

struct ExactCase {
    GridScene scene;
    std::vector<double> truth;
};

[[nodiscard]] PlaneChart chart_over(const FilmRectangle& film, std::size_t size, bool repeats) {
    return PlaneChart(glm::vec3(film.x_min, film.y_min, 0), glm::vec3(film.x_max - film.x_min, 0, 0),
                      glm::vec3(0, film.y_max - film.y_min, 0), size, size, repeats);
}

/// @param lens   lens(u, v, position) -> ThinLens
/// @param area   of the light across its direction, as the floor sees it
template <class S, class L, class Lens>
[[nodiscard]] GridScene grid_scene(const S& scene, const L& light, const PlaneChart& chart, double film_area,
                                   std::size_t nodes, double light_area, const WalkLimits& limits, const Lens& lens) {
    const auto side = std::size_t(std::llround(std::sqrt(double(nodes))));
    auto corners = trace_buffers(scene, light, {side + 1, side + 1, NodePlaces::corners}, limits);
    const auto centres = trace_buffers(scene, light, {side, side, NodePlaces::centres}, limits);
    const GridBuffer& buffer = centres.buffers.at(0);
    GridScene made{chart,
                   film_area,
                   std::move(corners.buffers.at(0)),
                   neighbour_tangents(buffer).deposits,
                   {},
                   light_area / double(side * side)};
    for (std::size_t j = 0; j < side; ++j)
        for (std::size_t i = 0; i < side; ++i)
            for (const auto& end : buffer.ends(i, j))
                made.lenses.push_back(lens(buffer.u(i), buffer.v(j), glm::dvec3(end.position)));
    return made;
}

[[nodiscard]] ExactCase wave(std::size_t nodes, std::size_t size) {
    const WaterWaves water({{0.04, 2, 1}});
    const auto lens = [&](double u, double v, const glm::dvec3& end) {
        const auto surface = water.at(u, v);
        return ThinLens{(WaterWaves::index - 1) / WaterWaves::index * surface.mean_curvature(),
                        glm::length(end - glm::dvec3(u, v, surface.z))};
    };
    const FilmRectangle film{0, 1, 0, 1};
    return {grid_scene(water, sun_over_square(), chart_over(film, size, true), 1, nodes, 1, {}, lens),
            *exact_picture({"wave-focused", film, size, size}, 1)};
}

[[nodiscard]] ExactCase ring_zoom(std::size_t nodes, std::size_t size) {
    const auto ring = *builtin_case<float, float>("ring-zoom", false);
    const BuiltinFilm film{"ring-zoom", ring.film, size, size};
    const double height = detail::ring_height, light_area = 2 * height / std::tan(detail::ring_elevation);
    const auto lens = [&](double u, double v, const glm::dvec3& end) {
        // A concave cylinder of radius 1: the mean of its curvatures is −1/2, and 1/d_image = −2 κ.
        const double y = 2 * u - 1;
        return ThinLens{1, glm::length(end - glm::dvec3(std::sqrt((1 - y) * (1 + y)), y, height * v))};
    };
    const double area = (ring.film.x_max - ring.film.x_min) * (ring.film.y_max - ring.film.y_min);
    return {grid_scene(ring.scene, ring.light, chart_over(ring.film, size, false), area, nodes, light_area,
                       walk_limits(film), lens),
            *exact_picture(film, 1)};
}

/// The least errors over s from `s_least` upwards, in steps of a sixth, and where rel is least. Ends where both errors
/// are well beyond their least, as they have one minimum.
[[nodiscard]] TableRow best(const RasterMethod& method, const ExactCase& one) {
    double rel = std::numeric_limits<double>::infinity(), rmse = rel, best_s = 0, energy = 0;
    for (double s = method.s_least; s <= method.s_most * 1.0001; s *= 1.17) {
        const std::vector<float> picture = method.picture(one.scene, s);
        const double now = relative_error(picture, one.truth);
        const double seen = picture_error(picture, one.truth, one.scene.chart.columns(), one.scene.chart.rows()).rmse;
        rmse = (std::min)(rmse, seen);
        if (now < rel)
            rel = now, best_s = s, energy = energy_error(picture, one.truth);
        if (now > 1.2 * rel && seen > 1.2 * rmse)
            break;
    }
    const auto text = [](const char* format, double x) {
        char digits[32];
        std::snprintf(digits, sizeof digits, format, x);
        return std::string(digits);
    };
    return {text("%.4f", rel) + " / " + text("%.4f", rmse), text("%.2f", best_s), text("%+.3f%%", 100 * energy)};
}

} // namespace

Table error_table(const Options& options) {
    Table table{"image-errors",
                "Photons on a grid, drawn onto a raster",
                "rel at the s that is best for it, RMSE at its own best; s and energy where rel is best",
                {"method"},
                {}};
    for (const RasterMethod& method : raster_methods())
        table.rows.push_back({method.title});
    for (const std::size_t nodes : options.nodes)
        for (const bool is_ring : {false, true}) {
            const ExactCase one = is_ring ? ring_zoom(nodes, options.size) : wave(nodes, options.size);
            const std::string name = (is_ring ? "ring-zoom " : "wave-focused ") + std::to_string(nodes);
            table.header.insert(table.header.end(), {name, "s", "energy"});
            for (std::size_t i = 0; i < raster_methods().size(); ++i) {
                const TableRow cells = best(raster_methods()[i], one);
                table.rows[i].insert(table.rows[i].end(), cells.begin(), cells.end());
            }
        }
    return table;
}

} // namespace nephroid::examples::study::image
