// SPDX-License-Identifier: MIT
/// @file  Flicker of moving water's caustics: how much the change of pictures from frame to frame misses the truth's.
#include "common/image/png.hpp"
#include "common/study/image/command.hpp"
#include "common/study/image/waves.hpp"

#include "nephroid/image/draw_sheets.hpp"
#include "nephroid/image/trace_buffer.hpp"
#include "nephroid/quality/exposure.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>

namespace nephroid::examples::study::image {

namespace {

/// Four crossing waves, each with its own speed.
[[nodiscard]] WaterWaves water_at(double time) {
    return WaterWaves(
        {{0.012, 2, 1, 0.3, 1.0}, {0.010, -1, 3, 1.7, 1.3}, {0.006, 4, -2, 4.1, -1.9}, {0.004, 3, 5, 2.9, 2.4}}, time);
}

[[nodiscard]] PlaneChart floor_chart(std::size_t size) {
    return PlaneChart(glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), size, size, true);
}

[[nodiscard]] GridScene scene_of(const WaterWaves& water, const FlickerOptions& options) {
    const std::size_t side = options.nodes;
    auto corners = trace_buffers(water, sun_over_square(), {side + 1, side + 1, NodePlaces::corners});
    const auto centres = trace_buffers(water, sun_over_square(), {side, side, NodePlaces::centres});
    GridScene scene{floor_chart(options.size),
                    1,
                    std::move(corners.buffers.at(0)),
                    neighbour_tangents(centres.buffers.at(0)).deposits,
                    {},
                    1 / double(side * side)};
    for (std::size_t j = 0; j < side; ++j)
        for (std::size_t i = 0; i < side; ++i) {
            const double u = centres.buffers[0].u(i), v = centres.buffers[0].v(j);
            const auto surface = water.at(u, v);
            scene.lenses.push_back(
                {(WaterWaves::index - 1) / WaterWaves::index * surface.mean_curvature(),
                 glm::length(glm::dvec3(scene.photons[j * side + i].position) - glm::dvec3(u, v, surface.z))});
        }
    return scene;
}

/// Flat quads of so many nodes that what they miss is far below what is measured.
[[nodiscard]] std::vector<float> truth_of(const WaterWaves& water, const FlickerOptions& options) {
    const std::size_t side = options.truth + 1;
    const auto traced = trace_buffers(water, sun_over_square(), {side, side, NodePlaces::corners});
    FloorMap map(floor_chart(options.size));
    draw_sheets(traced.buffers.at(0), map, {.tessellation = {.bend = 1, .density = 1, .max_quads = 1}});
    return pixels_of(map);
}

/// One method with one s, frame after frame.
struct Track {
    std::size_t method;
    double s;
    bool is_filtered; ///< the mean of three frames [Wyman and Davis 2006]
    std::vector<std::vector<float>> last{};
    std::vector<float> miss{}, seen_miss{}; ///< of the frame before
    double seen = 0, seen_flicker = 0, rel = 0, flicker = 0;

    void add(std::vector<float> picture, const std::vector<float>& truth, double exposure, bool counts) {
        if (is_filtered) {
            last.push_back(std::move(picture));
            if (last.size() > 3)
                last.erase(last.begin());
            picture.assign(truth.size(), 0);
            for (std::size_t i = 0; i < picture.size(); ++i)
                for (const auto& one : last)
                    picture[i] += one[i] / float(last.size());
        }
        std::vector<float> now(truth.size()), seen_now(truth.size());
        const auto clip = [exposure](float x) { return std::clamp(float(exposure) * x, 0.0f, 1.0f); };
        for (std::size_t i = 0; i < truth.size(); ++i) {
            now[i] = picture[i] - truth[i];
            seen_now[i] = clip(picture[i]) - clip(truth[i]);
            if (!counts)
                continue;
            rel += square(double(now[i])), seen += square(double(seen_now[i]));
            flicker += square(double(now[i] - miss[i])), seen_flicker += square(double(seen_now[i] - seen_miss[i]));
        }
        miss = std::move(now), seen_miss = std::move(seen_now);
    }
};

[[nodiscard]] std::vector<Track> tracks() {
    std::vector<Track> all;
    const auto& methods = raster_methods();
    for (std::size_t m = 0; m < methods.size(); ++m) {
        const bool is_splat = methods[m].s_least < methods[m].s_most;
        const std::vector<double> tried = !is_splat                ? std::vector<double>{1}
                                          : methods[m].s_most <= 2 ? std::vector<double>{0.35, 0.5, 0.7, 1}
                                                                   : std::vector<double>{1.5, 2, 2.5, 3, 4};
        for (const double s : tried)
            for (const bool is_filtered : {false, true})
                all.push_back({m, s, is_filtered});
    }
    return all;
}

[[nodiscard]] std::string text(double x) {
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.3f", x);
    return digits;
}

/// Frames side by side, a row for each thing shown, the first at the top.
void write_strip(const std::string& path, const std::vector<std::vector<std::vector<float>>>& rows, std::size_t size,
                 double exposure) {
    const std::size_t columns = rows.front().size(), width = columns * size, height = rows.size() * size;
    std::vector<float> all(width * height);
    for (std::size_t r = 0; r < rows.size(); ++r)
        for (std::size_t c = 0; c < columns; ++c)
            for (std::size_t j = 0; j < size; ++j)
                for (std::size_t i = 0; i < size; ++i)
                    all[((rows.size() - 1 - r) * size + j) * width + c * size + i] = rows[r][c][j * size + i];
    write_png(path, Samples(width, height, 1, std::move(all)), exposure);
}

} // namespace

Table flicker_table(const FlickerOptions& options) {
    std::vector<Track> all = tracks();
    std::vector<float> before;
    double exposure = 0, change = 0, seen_change = 0, mean_sum = 0;
    std::vector<std::vector<std::vector<float>>> strip(5);
    const std::size_t shown = 6;
    for (std::size_t frame = 0; frame < options.frames; ++frame) {
        const WaterWaves water = water_at(double(frame) * options.step);
        const GridScene scene = scene_of(water, options);
        const std::vector<float> truth = truth_of(water, options);
        if (frame == 0)
            exposure = picture_exposure(truth);
        // Not before a filter has all of its frames: so all methods have as many.
        const bool counts = frame >= 3;
        double mean = 0;
        for (std::size_t i = 0; i < truth.size(); ++i) {
            mean += double(truth[i]) / double(truth.size());
            if (counts) {
                const auto clip = [exposure](float x) { return std::clamp(exposure * double(x), 0.0, 1.0); };
                change += square(double(truth[i] - before[i]));
                seen_change += square(clip(truth[i]) - clip(before[i]));
            }
        }
        mean_sum += counts ? mean : 0;
        std::vector<float> picture;
        for (std::size_t k = 0; k < all.size(); ++k) {
            Track& track = all[k];
            if (!track.is_filtered) // the same picture as the one after it
                picture = raster_methods()[track.method].picture(scene, track.s);
            track.add(picture, truth, exposure, counts);
            const std::string& title = raster_methods()[track.method].title;
            if (!options.strip.empty() && frame < shown && !track.is_filtered) {
                if (title == "sheets (curved)")
                    strip[1].push_back(picture);
                else if (title == "neighbours, ellipse" && track.s == 2.5)
                    strip[2].push_back(picture);
                else if (title == "thin lens (4.2), one curvature" && track.s == 2)
                    strip[3].push_back(picture);
                else if (title == "multi-resolution (4.1)" && track.s == 0.5)
                    strip[4].push_back(picture);
            }
        }
        if (frame < shown)
            strip[0].push_back(truth);
        before = truth;
        std::cerr << "frame " << frame + 1 << " of " << options.frames << '\n';
    }
    if (!options.strip.empty())
        write_strip(options.strip, strip, options.size, exposure);
    const double frames = double(options.frames - 3), samples = frames * double(options.size * options.size),
                 mean = mean_sum / frames;
    Table table{"flicker",
                "Flicker of " + std::to_string(options.frames) + " frames, " + std::to_string(options.nodes) +
                    "² photons",
                "The truth's own change per frame is " + text(std::sqrt(change / samples) / mean) +
                    " of the mean, seen " + text(std::sqrt(seen_change / samples)),
                {"method", "s", "seen RMSE", "seen flicker", "rel", "rel's flicker"},
                {}};
    for (const bool is_filtered : {false, true})
        for (std::size_t m = 0; m < raster_methods().size(); ++m) {
            const Track* least = nullptr;
            for (const Track& track : all)
                if (track.method == m && track.is_filtered == is_filtered && (!least || track.seen < least->seen))
                    least = &track;
            const auto rms = [samples](double sum) { return std::sqrt(sum / samples); };
            const bool has_s = raster_methods()[m].s_least < raster_methods()[m].s_most;
            table.rows.push_back({raster_methods()[m].title + (is_filtered ? ", mean of three frames" : ""),
                                  has_s ? text(least->s) : "", text(rms(least->seen)), text(rms(least->seen_flicker)),
                                  text(rms(least->rel) / mean), text(rms(least->flicker) / mean)});
        }
    return table;
}

} // namespace nephroid::examples::study::image
