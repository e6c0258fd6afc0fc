// SPDX-License-Identifier: MIT
/// @file  Benchmarks of passes: from the lamp to the map, whole frames, two threads, and growth with photons and
///        vertices.
#pragma once

#include "common/benchmark/measure.hpp"
#include "common/benchmark/scenes.hpp"
#include "common/benchmark/table.hpp"
#include "common/benchmark/walks.hpp"
#include "common/builtin_cases.hpp"
#include "common/builtin_film.hpp"
#include "common/memory.hpp"
#include "common/stopwatch.hpp"

#include "nephroid/caustics.hpp"
#include "nephroid/gather/trace_photons.hpp"
#include "nephroid/relaxation/relax.hpp"

#include <limits>
#include <optional>
#include <string>

namespace nephroid::examples::benchmarks {

inline constexpr double no_ratio = std::numeric_limits<double>::quiet_NaN();

inline void benchmark_pass(const Effort& effort) {
    const auto water = water_scene(wavy_sheet(100));
    const auto vertices = film_vertices(512);
    const EyePathMap map(vertices, &Vertex::position, &Vertex::normal);
    auto sums = nephroid::sums<float>(map);
    const PhotonPass pass{.count = 1 << 16, .total = 1'000'000, .smoothing = 5};
    std::uint64_t caustic = 0;
    const auto over = [&](const auto& scene) {
        return [&] { caustic = splat_caustics(scene, sun(), sums, pass).caustic_photons(); };
    };
    const double items = double(pass.count);
    std::vector<Task> tasks{{items, over(water)}, {items, walks(water, sun(), pass.count, {})}};
#if defined(NEPHROID_EXAMPLES_HAS_EMBREE)
    const EmbreeWater embree(water);
    tasks.push_back({items, over(embree)});
    tasks.push_back({items, walks(embree, sun(), pass.count, {})});
#endif
    const auto t = seconds_per_item(effort, tasks);
    const double share = double(caustic) / items;
    print_row("pass, 20000 triangles, built-in tree, caustic photons", 1e-6 * share / t[0], "M/s", "1 M/s",
              1e-6 * share / t[0], Bar::at_least(1.2));
    print_row("  of which walking", 1e9 * t[1], "ns", "the pass", t[1] / t[0]);
    if (tasks.size() > 2) {
        print_row("pass, 20000 triangles, Embree, caustic photons", 1e-6 * share / t[2], "M/s", "1 M/s",
                  1e-6 * share / t[2], Bar::at_least(2));
        print_row("  of which walking", 1e9 * t[3], "ns", "the pass", t[3] / t[2]);
    }
}

/// The README's first frame: ring-zoom, 512 x 512, 20,000 photons, s = 5, one thread.
inline void benchmark_frame(const Effort& effort) {
    struct Seconds {
        double eye_paths, map, trace, splat, film, total;
    };
    Seconds best{0, 0, 0, 0, 0, std::numeric_limits<double>::infinity()};
    const auto builtin = builtin_case<float, float>("ring-zoom", false).value();
    const BuiltinFilm film{.scene = "ring-zoom", .view = builtin.film, .width = 512, .height = 512};
    ThreadExecutor one(1);
    for (unsigned i = 0; i < 3 * effort.repetitions; ++i) {
        Stopwatch total, stopwatch;
        Seconds now{};
        const auto vertices = floor_vertices(film);
        now.eye_paths = stopwatch.lap();
        const EyePathMap map(vertices, &FloorVertex::position, upwards);
        now.map = stopwatch.lap();
        auto sums = nephroid::sums<float>(map);
        TimingExecutor timing(one);
        splat_caustics(builtin.scene, builtin.light, sums,
                       {.count = 20'000, .smoothing = 5, .limits = walk_limits(film)}, HaltonSequence(), timing);
        now.trace = timing.trace_seconds();
        now.splat = timing.splat_seconds();
        (void)stopwatch.lap();
        std::vector<float> picture(film.pixels());
        sums.for_each([&](std::size_t vertex, float e) { picture[vertices[vertex].pixel] += e; });
        benchmark::DoNotOptimize(picture.data());
        now.film = stopwatch.lap();
        now.total = total.lap();
        if (now.total < best.total)
            best = now;
    }
    const auto part = [&](const char* name, double seconds) {
        print_row(std::string("frame, ring-zoom 512 x 512: ") + name, 1e3 * seconds, "ms", "the frame",
                  seconds / best.total);
    };
    part("eye paths", best.eye_paths);
    part("map", best.map);
    part("tracing, and leaves met", best.trace);
    part("splatting", best.splat);
    part("film", best.film);
    const double rest = best.total - best.eye_paths - best.map - best.trace - best.splat - best.film;
    print_row("frame, ring-zoom 512 x 512: unaccounted", 1e3 * rest, "ms", "the frame", rest / best.total,
              Bar::at_most(0.03));
}

inline void benchmark_threads(const Effort& effort) {
    ThreadExecutor one(1), two(2);
    const auto water = water_scene(wavy_sheet(100));
    const auto vertices = film_vertices(512);
    const EyePathMap map(vertices, &Vertex::position, &Vertex::normal);
    auto sums = nephroid::sums<float>(map);
    const auto trace = [&](ThreadExecutor& threads) {
        return [&] { (void)trace_photons(water, sun(), {.count = 1 << 16}, HaltonSequence(), threads); };
    };
    const auto splat = [&](ThreadExecutor& threads) {
        return
            [&] { splat_caustics(water, sun(), sums, {.count = 1 << 16, .smoothing = 12}, HaltonSequence(), threads); };
    };
    using Photon = Deposit<Vec, float>;
    const auto traced = trace_photons(water, sun(), {.count = 50'000});
    const auto relaxed = [&](ThreadExecutor& threads) {
        return [&] {
            auto moved = traced.deposits;
            relax(moved, photon_access(&Photon::position, &Photon::normal, &Photon::flux),
                  RelaxationOptions{.iterations = 5}, threads);
        };
    };
    const auto t = seconds_per_item(effort, {{1, trace(one), true},
                                             {1, trace(two), true},
                                             {1, splat(one), true},
                                             {1, splat(two), true},
                                             {1, relaxed(one), true},
                                             {1, relaxed(two), true}});
    for (std::size_t i = 0; const char* what : {"trace 65536 photons", "trace and splat 65536", "relax 50000"}) {
        print_row(std::string("two threads: ") + what, 1e3 * t[i + 1], "ms", "one thread", t[i] / t[i + 1],
                  Bar::at_least(1.85));
        i += 2;
    }
}

/// Seconds and memory for growing numbers of photons and vertices, each of one run. The cost of a photon and of a
/// vertex in its footprint is computed from the first and the third row; the other rows are compared with these costs.
inline void benchmark_growth(const Effort& effort) {
    struct Run {
        std::size_t side;
        double photons, reached, seconds, mebibytes;
    };
    const auto water = water_scene(wavy_sheet(100));
    const auto run = [&](std::size_t side, double photons) {
        const auto vertices = film_vertices(side);
        const EyePathMap map(vertices, &Vertex::position, &Vertex::normal);
        auto sums = nephroid::sums<float>(map);
        const MemoryPeak memory;
        Stopwatch stopwatch;
        splat_caustics(water, sun(), sums, {.count = std::uint64_t(photons), .smoothing = 8});
        const double seconds = stopwatch.lap();
        // A footprint of smoothing s is a disk of diameter s/√N on the sheet, and as large on the floor on the
        // average; the pixel filter adds √(2/3) of a pixel to its radius, in quadrature.
        const double radius2 = 16 / photons + 2.0 / 3 / double(side * side);
        return Run{side, photons, photons * pi<double> * radius2 * double(side * side), seconds,
                   memory.bytes().value_or(0) / (1 << 20)};
    };
    std::vector<Run> runs;
    for (const double photons : {1e4, 1e5, 1e6, 1e7, 1e8})
        if (photons < 5e6 || effort.full)
            runs.push_back(run(512, photons));
    for (const std::size_t side : {128u, 256u, 1024u, 2048u, 4096u})
        if (side < 2000 || effort.full)
            runs.push_back(run(side, 1e5));
    const Run &few = runs[0], &many = runs[2];
    const double vertex = (few.seconds * many.photons - many.seconds * few.photons) /
                          (few.reached * many.photons - many.reached * few.photons);
    const double photon = (many.seconds - many.reached * vertex) / many.photons;
    for (const Run& r : runs) {
        std::array<char, 100> what{};
        std::snprintf(what.data(), what.size(), "growth, %zu x %zu, %.0e photons, %.0f MiB more", r.side, r.side,
                      r.photons, r.mebibytes);
        print_row(what.data(), r.seconds, "s", "so many photons and vertices",
                  r.seconds / (r.photons * photon + r.reached * vertex));
    }
}

} // namespace nephroid::examples::benchmarks
