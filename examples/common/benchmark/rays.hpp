// SPDX-License-Identifier: MIT
/// @file  The examples' hierarchy against Embree, ray by ray.
#pragma once

#include "common/benchmark/measure.hpp"
#include "common/benchmark/scenes.hpp"
#include "common/benchmark/table.hpp"

#include <cstdio>

namespace nephroid::examples::benchmarks {

/// Rays from above onto the sheet: in rows and nearly parallel, or from anywhere to anywhere.
[[nodiscard]] inline std::vector<Ray<float>> test_rays(std::size_t side, bool coherent) {
    std::vector<Ray<float>> rays;
    const RandomSequence sequence(11);
    for (std::size_t i = 0; i < side * side; ++i) {
        Sampler<RandomSequence> draw(sequence, i);
        const auto in_square = [&](float z) { // of two rays, one number after the other
            const float x = draw.next<float>();
            return Vec(x, draw.next<float>(), z);
        };
        const Vec to = coherent ? Vec((float(i % side) + 0.5f) / float(side), (float(i / side) + 0.5f) / float(side), 1)
                                : in_square(1);
        const Vec from = coherent ? Vec(0.5f, 0.5f, 3) : in_square(1.5f);
        rays.push_back({from, normalize(Vec(to - from))});
    }
    return rays;
}

inline void benchmark_rays(const Effort& effort) {
#if defined(NEPHROID_EXAMPLES_HAS_EMBREE)
    for (const std::size_t side : {std::size_t(100), std::size_t(400), std::size_t(800)}) {
        if (side > 400 && !effort.full)
            continue;
        const MeshData<float> sheet = wavy_sheet(side);
        const TriangleMesh<float> mesh(sheet);
        const EmbreeMesh embree(sheet);
        for (const bool coherent : {true, false}) {
            const std::vector<Ray<float>> rays = test_rays(256, coherent);
            std::size_t hits = 0, their_hits = 0;
            const auto ours = [&] {
                hits = 0;
                for (const auto& ray : rays)
                    hits += mesh.nearest(ray, wide_t<float>(ray.t_max)).has_value();
                benchmark::DoNotOptimize(hits);
            };
            const auto theirs = [&] {
                their_hits = 0;
                for (const auto& ray : rays)
                    their_hits += embree.nearest(ray, coherent).has_value();
                benchmark::DoNotOptimize(their_hits);
            };
            const double items = double(rays.size());
            const auto t = seconds_per_item(effort, {{items, ours}, {items, theirs}});
            print_row(std::string(coherent ? "coherent" : "incoherent") + " rays, " +
                          std::to_string(sheet.triangles.size()) + " triangles",
                      1e-6 / t[0], "M/s", "Embree", t[1] / t[0], Bar::at_least(coherent ? 0.85 : 0.45));
            if (hits != their_hits)
                std::fprintf(stderr, "benchmark: %zu rays hit, and %zu in Embree\n", hits, their_hits);
        }
    }
#else
    (void)effort;
    std::fprintf(stderr, "benchmark: rays are left out, Embree is missing (Debian: libembree-dev)\n");
#endif
}

} // namespace nephroid::examples::benchmarks
