// SPDX-License-Identifier: MIT
#include "common/study/image/rivals.hpp"

#include "nephroid/image/draw_sheets.hpp"
#include "nephroid/vector/glm.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace nephroid::examples::study::image {

namespace {

const double full = 2 / std::sqrt(pi<double>); ///< of a tangent, for the area of a cell at s = 1

/// Photons with disks of these radii, given as the side of the square of the same area.
template <class Side>
[[nodiscard]] GridPhotons with_disks(const GridScene& scene, const Side& side) {
    GridPhotons disks = scene.photons;
    for (std::size_t i = 0; i < disks.size(); ++i) {
        const auto length = float(full * side(i));
        disks[i].d_position = {glm::vec3(length, 0, 0), glm::vec3(0, length, 0)};
    }
    return disks;
}

/// One size for all: that of the light's cells before they are bent.
[[nodiscard]] std::vector<float> fixed(const GridScene& scene, double s) {
    return draw_photons(scene, with_disks(scene, [&](std::size_t) { return std::sqrt(scene.cell); }), s);
}

/// The size of the light's cell behind a thin lens [Wyman and Dachsbacher 2008, eq. 7, with the absolute value that it
/// lacks].
[[nodiscard]] std::vector<float> thin_lens(const GridScene& scene, double s) {
    return draw_photons(scene,
                        with_disks(scene,
                                   [&](std::size_t i) {
                                       const ThinLens& lens = scene.lenses[i];
                                       return std::sqrt(scene.cell) *
                                              std::abs(1 - lens.d_background * lens.inverse_image);
                                   }),
                        s);
}

[[nodiscard]] std::vector<float> neighbours_disk(const GridScene& scene, double s) {
    return draw_photons(scene,
                        with_disks(scene,
                                   [&](std::size_t i) {
                                       const auto& d = scene.photons[i].d_position;
                                       return std::sqrt(double(glm::length(glm::cross(d[0], d[1])))) / full;
                                   }),
                        s);
}

[[nodiscard]] std::vector<float> neighbours_ellipse(const GridScene& scene, double s) {
    return draw_photons(scene, scene.photons, s);
}

/// A picture of disks of one radius, and how many of them cover each texel.
struct Level {
    std::vector<float> irradiance;
    std::vector<float> count;
};

/// @param radius  texels
[[nodiscard]] Level level_of(const GridScene& scene, double radius) {
    const double texel = std::sqrt(scene.film_area / double(scene.chart.columns() * scene.chart.rows()));
    const GridPhotons disks = with_disks(scene, [&](std::size_t) { return radius * texel * std::sqrt(pi<double>); });
    Level level{draw_photons(scene, disks, 1), std::vector<float>(scene.chart.columns() * scene.chart.rows(), 0.0f)};
    const auto columns = std::int64_t(scene.chart.columns()), rows = std::int64_t(scene.chart.rows());
    const auto wrap = [](std::int64_t i, std::int64_t n) { return (i % n + n) % n; };
    for (const auto& photon : scene.photons) {
        const auto place = scene.chart.place(nephroid::detail::double3(photon.position));
        if (!place)
            continue;
        const auto reach = std::int64_t(std::ceil(radius));
        const auto i0 = std::int64_t(std::floor(place->x)), j0 = std::int64_t(std::floor(place->y));
        for (std::int64_t j = j0 - reach; j <= j0 + reach; ++j)
            for (std::int64_t i = i0 - reach; i <= i0 + reach; ++i) {
                const bool is_inside = i >= 0 && j >= 0 && i < columns && j < rows;
                if (std::hypot(double(i) + 0.5 - place->x, double(j) + 0.5 - place->y) < radius &&
                    (is_inside || scene.chart.repeats()))
                    level.count[std::size_t(wrap(j, rows) * columns + wrap(i, columns))] += 1;
            }
    }
    return level;
}

/// Splats of four sizes, of which each pixel takes the smallest that has enough photons [Wyman and Dachsbacher 2008,
/// 4.1]. No blend is named: here finer pictures count with t²(3 − 2t), t = (count − 8)/8, and only where they
/// are brighter; the coarsest takes the rest. Keeps no energy, as it chooses between pictures that do.
[[nodiscard]] std::vector<float> multi_resolution(const GridScene& scene, double s) {
    // The paper's radii are for about a photon a texel.
    const double lit = scene.film_area / scene.cell;
    const double scale = s * std::sqrt(double(scene.chart.columns() * scene.chart.rows()) / lit);
    const std::array<double, 4> radii{1.5, 3.5, 5.5, 7.5};
    std::array<Level, 4> levels;
    for (std::size_t k = 0; k < 4; ++k)
        levels[k] = level_of(scene, radii[k] * scale);
    std::vector<float> picture = levels[3].irradiance;
    for (std::size_t i = 0; i < picture.size(); ++i)
        for (std::size_t k = 3; k-- > 0;) {
            const float finer = levels[k].irradiance[i];
            const float t = std::clamp((levels[k].count[i] - 8) / 8, 0.0f, 1.0f);
            if (finer > levels[k + 1].irradiance[i])
                picture[i] += t * t * (3 - 2 * t) * (finer - picture[i]);
        }
    return picture;
}

[[nodiscard]] std::vector<float> sheets_with(const GridScene& scene, const Tessellation& rule) {
    FloorMap map(scene.chart);
    draw_sheets(scene.corners, map, {.tessellation = rule});
    return pixels_of(map);
}

[[nodiscard]] std::vector<float> flat_quads(const GridScene& scene, double) {
    return sheets_with(scene, {.bend = 1, .density = 1, .max_quads = 1});
}

[[nodiscard]] std::vector<float> sheets(const GridScene& scene, double) {
    return sheets_with(scene, MapSheets{}.tessellation);
}

} // namespace

std::vector<float> pixels_of(const FloorMap& map) {
    std::vector<float> pixels;
    pixels.reserve(map.chart().columns() * map.chart().rows());
    for (std::size_t j = 0; j < map.chart().rows(); ++j)
        for (std::size_t i = 0; i < map.chart().columns(); ++i)
            pixels.push_back(map.texel(i, j).irradiance);
    return pixels;
}

std::vector<float> draw_photons(const GridScene& scene, const GridPhotons& photons, double smoothing) {
    FloorMap map(scene.chart);
    draw_splats(photons, map, {.smoothing = smoothing});
    return pixels_of(map);
}

const std::vector<RasterMethod>& raster_methods() {
    static const std::vector<RasterMethod> methods{
        {"fixed size, grid", 1, 10, fixed},
        {"multi-resolution (4.1)", 0.1, 2, multi_resolution},
        {"thin lens (4.2), one curvature", 1.5, 16, thin_lens},
        {"neighbours, disk of the cell's area", 1.5, 8, neighbours_disk},
        {"neighbours, ellipse", 1.5, 8, neighbours_ellipse},
        {"flat quads, exact coverage", 1, 1, flat_quads},
        {"sheets (curved)", 1, 1, sheets},
    };
    return methods;
}

} // namespace nephroid::examples::study::image
