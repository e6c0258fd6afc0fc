// SPDX-License-Identifier: MIT
/// @file  A caustic map for an engine: the light behind a built-in case's glass or mirror, as its lamp sees the floor,
///        as EXR with depth, and the matrix that takes a point of the world to it.
#include "common/builtin_film.hpp"
#include "common/command_line.hpp"
#include "common/image/exr.hpp"

#include "nephroid/execution/thread_executor.hpp"
#include "nephroid/image/draw_sheets.hpp"
#include "nephroid/image/projected_chart.hpp"
#include "nephroid/image/see_receiver.hpp"
#include "nephroid/image/trace_buffer.hpp"

#include <CLI/CLI.hpp>

#include <cmath>
#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

namespace {

using namespace nephroid::examples;
using nephroid::LightChart;
using Vec3 = glm::vec3;
using Case = BuiltinCase<float, float>;

struct Options {
    std::string scene = "ring", output = "caustic_map.exr";
    std::size_t nodes = 40'000, side = 1024;
    unsigned threads = 0;
};

/// From the lamp of a case, over the sphere about its film.
[[nodiscard]] LightChart light_chart(const Options& options, const Case& one) {
    const auto& film = one.film;
    const Vec3 centre(0.5 * (film.x_min + film.x_max), 0.5 * (film.y_min + film.y_max), 0);
    const double radius = 0.5 * std::hypot(film.x_max - film.x_min, film.y_max - film.y_min);
    if (options.scene == "ball-point")
        return LightChart(Vec3(0, 0, 5.25f), centre, radius, options.side);
    const bool is_ring = options.scene.starts_with("ring");
    const double elevation = is_ring ? nephroid::examples::detail::ring_elevation : nephroid::pi<double> / 2;
    return LightChart::along(Vec3(is_ring ? std::cos(elevation) : 0, 0, -std::sin(elevation)), centre, radius,
                             options.side);
}

void run(const Options& options) {
    if (!is_builtin(options.scene) || options.scene.starts_with("wave") || options.scene.starts_with("ring-disk"))
        throw UsageError("'" + options.scene + "' is none of ring, ring-zoom, ball, ball-point");
    require_openexr(options.output);
    const Case one = *builtin_case<float, float>(options.scene, false);
    nephroid::ThreadExecutor threads(options.threads);
    nephroid::CausticMap<Vec3, float, LightChart> map(light_chart(options, one),
                                                      nephroid::SeeReceiver<Scene<float, float>, Vec3>(one.scene));
    double emitted = 0, arrived = 0;
    for (const auto& chart : nephroid::charts_of(one.light, 1).charts) {
        const auto grid = nephroid::square_grid(chart, double(options.nodes), nephroid::NodePlaces::corners);
        const auto buffer = nephroid::trace_buffer(one.scene, chart, grid, {}, threads);
        const nephroid::MapAccount account = nephroid::draw_sheets(buffer, map, {}, threads);
        emitted += account.light.emitted.flux;
        arrived += account.light[nephroid::Fate::splatted].flux;
    }
    std::vector<float> irradiance, depth;
    for (std::size_t j = 0; j < options.side; ++j)
        for (std::size_t i = 0; i < options.side; ++i) {
            irradiance.push_back(map.texel(i, j).irradiance);
            depth.push_back(map.texel(i, j).depth);
        }
    write_exr_layers(options.output, {{"", Samples(options.side, options.side, 1, std::move(irradiance))},
                                      {"depth", Samples(options.side, options.side, 1, std::move(depth))}});
    std::cout << "# (x, y, z, 1) to (column w, row w, depth, w), row 0 at the bottom; " << arrived << " of " << emitted
              << " emitted arrived\n";
    const auto matrix = map.chart().matrix();
    for (std::size_t row = 0; row < 4; ++row)
        std::printf("%.9g %.9g %.9g %.9g\n", matrix[4 * row], matrix[4 * row + 1], matrix[4 * row + 2],
                    matrix[4 * row + 3]);
}

} // namespace

int main(int argc, char** argv) {
    try {
        Options options;
        CLI::App app("Writes the caustic map of a built-in case: irradiance and depth, as its lamp sees the floor",
                     "caustic_map");
        app.add_option("case", options.scene, "ring, ring-zoom, ball or ball-point [ring]");
        app.add_option("--output", options.output, "An .exr file: channels Y and depth.Y [caustic_map.exr]");
        app.add_option("--nodes", options.nodes, "Photons of the grid [40000]")->check(CLI::Range(4, 1 << 30));
        app.add_option("--size", options.side, "Texels a side [1024]")->check(CLI::Range(1, 16384));
        app.add_option("--threads", options.threads, "0: as many as the machine has [0]");
        if (parse(app, argc, argv))
            run(options);
        return 0;
    } catch (const UsageError& error) {
        std::cerr << "caustic_map: " << error.what() << '\n';
        return 2;
    } catch (const std::exception& error) {
        std::cerr << "caustic_map: " << error.what() << '\n';
        return 1;
    }
}
