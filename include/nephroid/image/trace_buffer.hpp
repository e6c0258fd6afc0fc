// SPDX-License-Identifier: MIT
/// @file  Traces a lamp's photons into photon buffers, one for each of its charts.
#pragma once

#include "nephroid/emission/chart/charts_of.hpp"
#include "nephroid/execution/checked_executor.hpp"
#include "nephroid/image/photon_buffer.hpp"
#include "nephroid/sheet/node_tracer.hpp"
#include "nephroid/transport/walk_limits.hpp"

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

namespace nephroid {

namespace detail {
/// Whether a scene's hits say which surface they are on.
template <class S, class V>
inline constexpr bool knows_surfaces = requires(const S& scene, const V& v, scalar_t<V> t) {
    { (*scene.intersect(v, v, t, t)).surface } -> std::convertible_to<std::uint64_t>;
};
} // namespace detail

/// Traces the photons of one chart. All the ways of light are followed if the scene tells them (`scatter_all`): a
/// photon that chose by chance would have no neighbours. A hit needs neither `curvature` nor tangents.
///
/// ```cpp
/// const auto buffers = nephroid::trace_buffers(scene, light, {.columns = 141, .rows = 141}, {}, threads);
/// ```
///
/// @param limits    of each photon's path
/// @param executor  the buffer does not depend on it, bit for bit
template <class S, Vector3 V, Flux F, class E = SerialExecutor>
[[nodiscard]] PhotonBuffer<V, F> trace_buffer(const S& scene, const EmissionChart<V, F>& chart, const PhotonGrid& grid,
                                              const WalkLimits& limits = {}, E&& executor = E{}) {
    using T = scalar_t<V>;
    PhotonBuffer<V, F> buffer(chart, grid, detail::knows_surfaces<S, V>);
    detail::CheckedExecutor checked(executor);
    std::vector<detail::TracedNodes> traced(buffer.tasks());
    announce(checked, Phase::trace);
    buffer.fill(
        [&](std::size_t i, std::size_t j, auto& ends, std::size_t task) {
            detail::trace_node(scene, chart, T(buffer.u(i)), T(buffer.v(j)), buffer.area(i, j), zero_vector<V>(),
                               limits, ends, traced[task]);
        },
        checked);
    for (const detail::TracedNodes& one : traced)
        buffer.book(one.account, one.landed, one.by_chance);
    return buffer;
}

/// The photon buffers of a lamp or of several.
template <Vector3 V, Flux F>
struct PhotonBuffers {
    std::vector<PhotonBuffer<V, F>> buffers;
    double without_charts = 0; ///< power of lamps that have no charts, and so no buffer
};

/// Traces a lamp's photons, or those of a set of lamps: the same grid over each chart.
///
/// @param lamp_points  that stand for a lamp with an area, >= 1; each has a chart of its own
template <class S, class L, class E = SerialExecutor>
[[nodiscard]] auto trace_buffers(const S& scene, const L& light, const PhotonGrid& grid, const WalkLimits& limits = {},
                                 E&& executor = E{}, std::size_t lamp_points = 16) {
    auto lamps = charts_of(light, lamp_points);
    PhotonBuffers<typename L::vector, typename L::flux_type> traced{{}, lamps.power_without};
    for (const auto& chart : lamps.charts)
        traced.buffers.push_back(trace_buffer(scene, chart, grid, limits, executor));
    return traced;
}

} // namespace nephroid
