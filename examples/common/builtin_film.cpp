// SPDX-License-Identifier: MIT
#include "common/builtin_film.hpp"

#include "common/command_line.hpp"

#include "nephroid/quality/reference/ball.hpp"
#include "nephroid/quality/reference/ring.hpp"
#include "nephroid/quality/reference/wave.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace nephroid::examples {

namespace {

/// The samples' positions in a pixel, from 0 to 1: the centre, a square grid, or a lattice if their number is no
/// square.
[[nodiscard]] std::vector<std::array<double, 2>> positions_in_pixel(unsigned samples) {
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

[[nodiscard]] double amplitude_of(const std::string& wave) { return wave == "wave-prefocal" ? 0.012 : 0.04; }

/// How much longer a footprint can be on the wave's floor than at the lamp: the largest derivative, by differences over
/// one period, of the landing position by the entry position, along the wave's gradient.
[[nodiscard]] double wave_stretch(double amplitude) {
    constexpr int steps = 4096;
    const double k = 2 * std::numbers::pi, gradient = std::sqrt(5.0); // of 2x + y
    const auto landing = [&](double t) {                              // both along the gradient, in units of length
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

void check(const BuiltinFilm& film) {
    if (film.one_reflection && !film.scene.starts_with("ring"))
        throw UsageError("--reflections: only the ring reflects more than once");
    if (film.fresnel && film.scene.starts_with("ring"))
        throw UsageError("--fresnel: the ring is a perfect mirror");
    const auto& [x_min, x_max, y_min, y_max] = film.view;
    if (film.scene.starts_with("wave") && (x_min < 0 || x_max > 1 || y_min < 0 || y_max > 1))
        throw UsageError("--view: the wave is periodic; look at a part of 0 1 0 1");
}

WalkLimits walk_limits(const BuiltinFilm& film) {
    return {.specular_events = film.one_reflection ? 1u : 1u << 16, .roulette_after = 1u << 16};
}

PixelFootprint<glm::vec3> footprint_of(const BuiltinFilm& film) {
    const double side = std::sqrt(double(film.samples)); // cells of a grid, or as large where there is no grid
    const double dx = (film.view.x_max - film.view.x_min) / double(film.width) / side;
    const double dy = (film.view.y_max - film.view.y_min) / double(film.height) / side;
    return {{static_cast<float>(dx), 0.f, 0.f}, {0.f, static_cast<float>(dy), 0.f}};
}

std::vector<FloorVertex> floor_vertices(const BuiltinFilm& film, std::optional<double> ghosts) {
    const double dx = (film.view.x_max - film.view.x_min) / double(film.width);
    const double dy = (film.view.y_max - film.view.y_min) / double(film.height);
    const auto places = positions_in_pixel(film.samples);
    const int periods = ghosts ? static_cast<int>(std::ceil(*ghosts)) : 0;
    const auto is_near = [&](double coordinate) {
        return !ghosts || (coordinate >= -*ghosts && coordinate <= 1 + *ghosts);
    };

    std::vector<FloorVertex> vertices;
    for (int period_y = -periods; period_y <= periods; ++period_y)
        for (int period_x = -periods; period_x <= periods; ++period_x)
            for (std::size_t pixel = 0; pixel < film.pixels(); ++pixel)
                for (const auto& place : places) {
                    const double x = period_x + film.view.x_min + (double(pixel % film.width) + place[0]) * dx;
                    const double y = period_y + film.view.y_min + (double(pixel / film.width) + place[1]) * dy;
                    if (is_near(x) && is_near(y))
                        vertices.push_back(
                            {{static_cast<float>(x), static_cast<float>(y), 0.f}, static_cast<std::uint32_t>(pixel)});
                }
    return vertices;
}

double ghost_margin(const BuiltinFilm& film, double smoothing, double emitted) {
    const double radius = smoothing / std::sqrt(std::numbers::pi * emitted);
    return 1.01 * wave_stretch(amplitude_of(film.scene)) * radius + 2 * film.pixel();
}

bool has_exact_picture(const std::string& scene) {
    return is_builtin(scene) && scene != "ring-disk" && scene != "ring-disk-zoom";
}

std::optional<std::vector<double>> exact_picture(const BuiltinFilm& film, unsigned threads) {
    ThreadExecutor executor(threads);
    const auto& [x_min, x_max, y_min, y_max] = film.view;
    const reference::Film rectangle{
        x_min, x_max, y_min, y_max, static_cast<int>(film.width), static_cast<int>(film.height)};
    if (film.scene.starts_with("wave"))
        return reference::wave({.amplitude = amplitude_of(film.scene), .fresnel = film.fresnel}, rectangle, executor);
    if (film.scene == "ring" || film.scene == "ring-zoom")
        return reference::ring(
            {.reflections = film.one_reflection ? reference::Reflections::one : reference::Reflections::any}, rectangle,
            executor);
    if (film.scene == "ball" || film.scene == "ball-point")
        return reference::ball(
            {.source = film.scene == "ball-point" ? reference::BallLight::point : reference::BallLight::collimated,
             .fresnel = film.fresnel},
            rectangle, executor);
    return std::nullopt;
}

} // namespace nephroid::examples
