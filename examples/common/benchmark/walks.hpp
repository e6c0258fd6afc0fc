// SPDX-License-Identifier: MIT
/// @file  Benchmarks of walks: the order in which photons are traced, and the cost of tangents.
#pragma once

#include "common/benchmark/measure.hpp"
#include "common/benchmark/scenes.hpp"
#include "common/benchmark/table.hpp"
#include "common/builtin_cases.hpp"

#include "nephroid/pass/traced_batch.hpp"
#include "nephroid/transport/walk.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace nephroid::examples::benchmarks {

/// Walks photons 0 to count − 1, and keeps none.
template <class S, class L>
[[nodiscard]] auto walks(const S& scene, const L& light, std::uint64_t count, const WalkLimits& limits) {
    return [&scene, light, count, limits] {
        Statistics account;
        const HaltonSequence sequence;
        const Spread<float> spread{float(count), 8};
        for (std::uint64_t i = 0; i < count; ++i) {
            Sampler<HaltonSequence> sampler(sequence, i);
            auto deposit = walk(scene, light.emit(sampler, spread), sampler, limits, account);
            benchmark::DoNotOptimize(deposit);
        }
    };
}

/// Traces 65,536 photons as a batch does, neighbours at the lamp one after the other, and in the order of their
/// indices.
template <class Sequence, class S>
void benchmark_order_in(const Effort& effort, const std::string& name, const S& scene) {
    constexpr std::uint64_t photons = 1 << 16;
    const Sequence sequence;
    const auto light = sun();
    const auto trace_one = [&](std::uint64_t i, Statistics& account) {
        Sampler<Sequence> sampler(sequence, i);
        return walk(scene, light.emit(sampler, Spread<float>{float(photons), 8}), sampler, WalkLimits{}, account);
    };
    SerialExecutor executor;
    nephroid::detail::TracedBatch<std::optional<Deposit<Vec, float>>> batch;
    const auto coherent = [&] { (void)batch.trace(light, sequence, 0, 0, photons, trace_one, executor); };
    const auto by_index = [&] {
        Statistics account;
        for (std::uint64_t i = 0; i < photons; ++i) {
            auto deposit = trace_one(i, account);
            benchmark::DoNotOptimize(deposit);
        }
    };
    nephroid::detail::CoherentOrder order;
    const auto sort = [&] { benchmark::DoNotOptimize(order.sort(light, sequence, 0, photons, executor).data()); };
    const double items = double(photons);
    const auto t = seconds_per_item(effort, {{items, coherent}, {items, by_index}, {items, sort}});
    print_row("coherent order, " + name, 1e9 * t[0], "ns", "speed in order of index", t[1] / t[0]);
    print_row("  of which sorting", 1e9 * t[2], "ns", "the whole", t[2] / t[0]);
}

inline void benchmark_order(const Effort& effort) {
    for (const std::size_t side : {std::size_t(100), std::size_t(400), std::size_t(800)}) {
        if (side > 400 && !effort.full)
            continue;
        const auto water = water_scene(wavy_sheet(side));
        const std::string triangles = std::to_string(2 * side * side) + " triangles, ";
        benchmark_order_in<HaltonSequence>(effort, triangles + "Halton", water);
        benchmark_order_in<RandomSequence>(effort, triangles + "random", water);
#if defined(NEPHROID_EXAMPLES_HAS_EMBREE)
        const EmbreeWater embree(water);
        benchmark_order_in<HaltonSequence>(effort, triangles + "Embree, Halton", embree);
        benchmark_order_in<RandomSequence>(effort, triangles + "Embree, random", embree);
#endif
    }
}

template <class S, class L>
void benchmark_tangents_in(const Effort& effort, const std::string& name, const S& scene, const L& light, double bar,
                           const WalkLimits& limits = {}) {
    constexpr std::uint64_t photons = 1 << 14;
    const double items = double(photons);
    const auto t = seconds_per_item(effort, {{items, walks(scene, light, photons, limits)},
                                             {items, walks(scene, WithoutTangents(light), photons, limits)}});
    print_row("walk with two tangents, " + name, 1e-6 / t[0], "M/s", "the walk without", t[0] / t[1],
              Bar::at_most(bar));
}

inline void benchmark_tangents(const Effort& effort) {
    const auto mesh = water_scene(wavy_sheet(200));
    benchmark_tangents_in(effort, "80000 triangles", mesh, sun(), 1.15);
    for (const char* name : {"wave-focused", "ring", "ball"}) {
        const auto builtin = builtin_case<float, float>(name, false).value();
        benchmark_tangents_in(effort, name, builtin.scene, builtin.light, 1.4);
    }
}

} // namespace nephroid::examples::benchmarks
