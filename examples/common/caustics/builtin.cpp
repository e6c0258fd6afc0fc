// SPDX-License-Identifier: MIT
#include "common/caustics/builtin.hpp"

#include "common/builtin_cases.hpp"
#include "common/caustics/render.hpp"

#include "nephroid/quality/error.hpp"
#include "nephroid/quality/exposure.hpp"
#include "nephroid/vector/glm.hpp"

#include "reference/ball.hpp"
#include "reference/ring.hpp"
#include "reference/wave.hpp"

#include <algorithm>
#include <numbers>

namespace nephroid::examples {

namespace {

using Case = BuiltinCase<float, float>;

/// Where a film's eye path ends on the floor.
struct FloorVertex {
    glm::vec3 position;
    std::uint32_t pixel;
};

[[nodiscard]] glm::vec3 upwards(const FloorVertex&) { return {0, 0, 1}; }

/// Places in a pixel, from 0 to 1: the centre, a square grid, or a lattice for numbers that are no squares.
[[nodiscard]] std::vector<std::array<double, 2>> places_in_pixel(unsigned samples) {
    std::vector<std::array<double, 2>> places;
    const auto side = static_cast<unsigned>(std::lround(std::sqrt(double(samples))));
    for (unsigned i = 0; i < samples; ++i) {
        if (side * side == samples) {
            places.push_back({(i % side + 0.5) / side, (i / side + 0.5) / side});
        } else {
            const double golden = 0.5 + 0.6180339887498949 * i;
            places.push_back({(i + 0.5) / samples, golden - std::floor(golden)});
        }
    }
    return places;
}

/// How much longer than at the lamp a footprint can be on the wave's floor: the largest change of where light lands with
/// where it enters, along the wave's gradient, by differences over one period.
[[nodiscard]] double wave_stretch(double amplitude) {
    constexpr int steps = 4096;
    const double k = 2 * std::numbers::pi, gradient = std::sqrt(5.0); // of 2x + y
    const auto landing = [&](double t) { // both along the gradient, in units of length
        const double phase = k * gradient * t;
        const double slope = amplitude * k * gradient * std::cos(phase);
        const double incident = std::atan(slope), refracted = std::asin(std::sin(incident) / 1.33);
        return t + (1 + amplitude * std::sin(phase)) * std::tan(incident - refracted);
    };
    double most = 1;
    const double step = 1 / (gradient * steps);
    for (int i = 0; i < steps; ++i)
        most = (std::max)(most, std::abs(landing((i + 1) * step) - landing(i * step)) / step);
    return most;
}

/// How far beyond a periodic floor's border its ghosts reach: the longest radius a footprint can have, and at least an
/// eighth of the period, so that the map is the same for all but very smooth pictures.
[[nodiscard]] double ghost_margin(const Options& options, double amplitude, double pixel) {
    const double emitted = double(options.emit.value_or(options.photons));
    const double radius = options.smoothing / std::sqrt(std::numbers::pi * emitted);
    const double margin = (std::max)(0.125, 1.01 * wave_stretch(amplitude) * radius + 2 * pixel);
    if (margin > 4)
        throw UsageError("--smoothing, --photons: footprints would reach over " + std::to_string(std::lround(margin)) +
                         " periods of the wave; use less smoothing or more photons");
    return margin;
}

/// @param ghosts  for a floor of period 1 along x and y: how far beyond the unit square the film is repeated
[[nodiscard]] std::vector<FloorVertex> floor_vertices(const FilmRectangle& film, const Options& options,
                                                      std::optional<double> ghosts) {
    const double dx = (film.x_max - film.x_min) / double(options.width);
    const double dy = (film.y_max - film.y_min) / double(options.height);
    const auto places = places_in_pixel(options.samples);
    const int periods = ghosts ? static_cast<int>(std::ceil(*ghosts)) : 0;
    const auto is_near = [&](double coordinate) {
        return !ghosts || (coordinate >= -*ghosts && coordinate <= 1 + *ghosts);
    };

    std::vector<FloorVertex> vertices;
    for (int period_y = -periods; period_y <= periods; ++period_y)
        for (int period_x = -periods; period_x <= periods; ++period_x)
            for (std::size_t pixel = 0; pixel < options.width * options.height; ++pixel)
                for (const auto& place : places) {
                    const double x = period_x + film.x_min + (double(pixel % options.width) + place[0]) * dx;
                    const double y = period_y + film.y_min + (double(pixel / options.width) + place[1]) * dy;
                    if (is_near(x) && is_near(y))
                        vertices.push_back({{static_cast<float>(x), static_cast<float>(y), 0.f},
                                            static_cast<std::uint32_t>(pixel)});
                }
    return vertices;
}

[[nodiscard]] double amplitude_of(const std::string& name) { return name == "wave-prefocal" ? 0.012 : 0.04; }

[[nodiscard]] reference::Image exact_picture(const Options& options, const FilmRectangle& view) {
    const reference::Film film{view.x_min,
                               view.x_max,
                               view.y_min,
                               view.y_max,
                               static_cast<int>(options.width),
                               static_cast<int>(options.height)};
    if (options.scene.starts_with("wave"))
        return reference::wave({.amplitude = amplitude_of(options.scene), .fresnel = options.fresnel}, film,
                               options.threads);
    if (options.scene.starts_with("ring"))
        return reference::ring({.reflections = options.one_reflection ? reference::Reflections::one
                                                                      : reference::Reflections::any},
                               film, options.threads);
    return reference::ball({.source = options.scene == "ball-point" ? reference::BallLight::point
                                                                    : reference::BallLight::collimated,
                            .fresnel = options.fresnel},
                           film, options.threads);
}

[[nodiscard]] std::optional<Errors> errors_against(const reference::Image& exact, const std::vector<float>& irradiance,
                                                   const Options& options) {
    if (!(reference::mean(exact) > 0))
        return std::nullopt; // no light falls on this film
    Errors errors;
    errors.relative = relative_error(irradiance, exact);
    errors.energy = energy_error(irradiance, exact);
    if (std::min(options.width, options.height) >= SsimOptions{}.window) {
        const PictureError error = picture_error(irradiance, exact, options.width, options.height);
        errors.rmse = error.rmse;
        errors.ssim = error.ssim;
    } else {
        const double exposure = picture_exposure(exact);
        errors.rmse = rmse(exposed(irradiance, exposure), exposed(exact, exposure));
        errors.ssim = std::nan("");
    }
    return errors;
}

void check(const Options& options) {
    if (options.layer != Layer::all)
        throw UsageError("--layer: a built-in case has caustics only");
    if (options.one_reflection && !options.scene.starts_with("ring"))
        throw UsageError("--reflections: only the ring reflects more than once");
    if (options.fresnel && options.scene.starts_with("ring"))
        throw UsageError("--fresnel: the ring is a perfect mirror");
    if (options.view && options.scene.starts_with("wave")) {
        const auto& [x_min, x_max, y_min, y_max] = *options.view;
        if (x_min < 0 || x_max > 1 || y_min < 0 || y_max > 1)
            throw UsageError("--view: the wave is periodic; look at a part of 0 1 0 1");
    }
}

} // namespace

std::string builtin_names() {
    std::string names;
    for (const std::string_view name : builtin_case_names)
        names += (names.empty() ? "" : ", ") + std::string(name);
    return names;
}

bool is_builtin(const std::string& name) {
    return std::ranges::find(builtin_case_names, name) != builtin_case_names.end();
}

Rendering render_builtin(const Options& options) {
    check(options);
    Stopwatch total, stopwatch;
    Case builtin = builtin_case<float, float>(options.scene, options.fresnel).value();
    if (options.view) {
        const auto& [x_min, x_max, y_min, y_max] = *options.view;
        builtin.film = {x_min, x_max, y_min, y_max};
    }
    const double pixel = (builtin.film.x_max - builtin.film.x_min) / double(options.width);
    ThreadExecutor threads(options.threads);

    Report report;
    report.threads = threads.threads();
    std::optional<double> ghosts;
    if (builtin.periodic)
        ghosts = ghost_margin(options, amplitude_of(options.scene), pixel);
    const auto vertices = floor_vertices(builtin.film, options, ghosts);
    report.eye_vertices = vertices.size();
    report.seconds.eye_paths = stopwatch.lap();
    const EyePathMap map(vertices, &FloorVertex::position, upwards);
    report.seconds.map = stopwatch.lap();

    std::vector<float> irradiance(options.width * options.height);
    const auto film = [&](std::size_t vertex, float e) {
        irradiance[vertices[vertex].pixel] += e / static_cast<float>(options.samples);
    };
    const WalkLimits limits{.specular_events = options.one_reflection ? 1u : 1u << 16, .roulette_after = 1u << 16};
    splat_caustics_timed<float>(builtin.scene, builtin.light, map, limits, options, threads, report, film);
    report.seconds.total = total.lap();

    const reference::Image exact = exact_picture(options, builtin.film);
    report.errors = errors_against(exact, irradiance, options);
    const double exposure = report.errors ? picture_exposure(exact) : 1;
    return {Samples{options.width, options.height, 1, std::move(irradiance)}, exposure, std::move(report)};
}

} // namespace nephroid::examples
