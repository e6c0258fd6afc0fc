// SPDX-License-Identifier: MIT
#include "common/caustics/builtin.hpp"

#include "common/builtin_film.hpp"
#include "common/caustics/render.hpp"
#include "common/caustics/render_sheets.hpp"

#include "nephroid/quality/exposure.hpp"

#include <algorithm>

namespace nephroid::examples {

namespace {

using Case = BuiltinCase<float, float>;

[[nodiscard]] BuiltinFilm film_of(const Options& options, FilmRectangle view) {
    if (options.view)
        view = {(*options.view)[0], (*options.view)[1], (*options.view)[2], (*options.view)[3]};
    return {options.scene,         view, options.width, options.height, options.samples, options.fresnel,
            options.one_reflection};
}

/// The distance beyond a periodic floor's border up to which there are ghosts: at least an eighth of the period, so
/// that all but very smooth pictures have the same map.
[[nodiscard]] double ghosts_of(const BuiltinFilm& film, const Options& options) {
    if (options.method == Method::sheets)
        return 0.25; // light moves less than that from its place in the lamp's patch
    const double emitted = double(options.emit.value_or(options.photons));
    const double largest =
        options.first_order ? default_smoothing : bounds_for(SmoothingBounds{}, emitted).largest_radius;
    const double margin = (std::max)(0.125, ghost_margin(film, options.smoothing.value_or(largest), emitted));
    if (margin > 4)
        throw UsageError("--smoothing, --photons: footprints would reach over " + std::to_string(std::lround(margin)) +
                         " periods of the wave; use less smoothing or more photons");
    return margin;
}

/// The exposure for the exact picture, or for the picture itself if there is no exact one; 1 if all is dark.
[[nodiscard]] double exposure_of(const std::optional<std::vector<double>>& exact,
                                 const std::vector<float>& irradiance) {
    const auto is_lit = [](auto pixel) { return pixel > 0; };
    if (exact)
        return std::ranges::any_of(*exact, is_lit) ? picture_exposure(*exact) : 1;
    return std::ranges::any_of(irradiance, is_lit) ? picture_exposure(irradiance) : 1;
}

} // namespace

Rendering render_builtin(const Options& options) {
    if (options.layer != Layer::all || options.bounces.value_or(0) > 0)
        throw UsageError("--layer, --bounces: a built-in case has caustics only; its light bounces nowhere");
    Stopwatch total, stopwatch;
    const Case builtin = builtin_case<float, float>(options.scene, options.fresnel).value();
    if (options.cross_validated && builtin.periodic)
        throw UsageError(
            "--smoothing: cross-validated would take the border of the wave's tile, which is not to be seen, "
            "for an edge of its caustic; choose s by hand");
    const BuiltinFilm film = film_of(options, builtin.film);
    check(film);
    ThreadExecutor threads(options.threads);

    Report report;
    report.threads = threads.threads();
    const auto vertices =
        floor_vertices(film, builtin.periodic ? std::optional(ghosts_of(film, options)) : std::nullopt);
    report.eye_vertices = vertices.size();
    report.seconds.eye_paths = stopwatch.lap();
    const auto footprint = [pixel = footprint_of(film)](const FloorVertex&) { return pixel; };
    const bool are_sheets = options.method == Method::sheets;
    const EyePathMap<glm::vec3> map = are_sheets
                                          ? EyePathMap<glm::vec3>(vertices, &FloorVertex::position, upwards, footprint)
                                          : EyePathMap<glm::vec3>(vertices, &FloorVertex::position, upwards);
    report.seconds.map = stopwatch.lap();

    const auto pixels_of = [&](const auto& sums) {
        std::vector<float> pixels(film.pixels());
        sums.for_each([&](std::size_t vertex, float e) {
            pixels[vertices[vertex].pixel] += e / static_cast<float>(options.samples);
        });
        return pixels;
    };
    auto layer = are_sheets ? draw_sheets_timed<float>(builtin.scene_for_sheets(), builtin.light, map,
                                                       walk_limits(film), options, threads, report, pixels_of)
                            : splat_caustics_timed<float>(builtin.scene, builtin.light, map, walk_limits(film), options,
                                                          builtin.periodic, threads, report, pixels_of);
    std::vector<float>& irradiance = layer.pixels;
    report.seconds.total = total.lap();

    const auto exact = exact_picture(film, options.threads);
    if (exact)
        report.errors = errors_against(*exact, irradiance, options.width, options.height);
    else
        report.note("the exact picture of " + options.scene + " is not known, so no errors are given");
    const double exposure = exposure_of(exact, irradiance);
    Samples picture(options.width, options.height, 1, std::move(irradiance));
    return {picture, exposure, std::move(report), {{"caustics", picture, std::move(layer.variance)}}};
}

} // namespace nephroid::examples
