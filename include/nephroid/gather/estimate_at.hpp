// SPDX-License-Identifier: MIT
/// @file  The loop over the picture: an estimate at every eye path vertex.
#pragma once

#include "nephroid/execution/executor.hpp"
#include "nephroid/receiver/sink.hpp"
#include "nephroid/tree/element_at.hpp"

#include <algorithm>
#include <functional>
#include <ranges>
#include <type_traits>
#include <utility>
#include <vector>

namespace nephroid {

/// Estimates at every vertex of the user's array, then calls sink(vertex index, estimate) serially and in the array's
/// order. Look-ups are fast where neighbouring vertices follow each other, as in a picture.
///
/// @param vertices  a random-access range
/// @param position  projection: a member pointer or a callable
/// @param normal    projection, unit
/// @param estimate  estimate(position, normal): NearestPhotons, FixedRange, DifferentialMap, DiffusionEstimate, or any
///                  callable like them; called from several threads at once
/// @param executor  who runs the work; the result does not depend on it
/// @param sink      `Sink` (receiver/sink.hpp). All estimates are kept until the first of its calls
template <std::ranges::random_access_range Vertices, class Position, class Normal, class Estimate, class E, class S>
    requires ExecutorArgument<E>
void estimate_at(const Vertices& vertices, Position position, Normal normal, const Estimate& estimate, E&& executor,
                 S&& sink) {
    using Vertex = std::ranges::range_reference_t<const Vertices>;
    using F = std::remove_cvref_t<std::invoke_result_t<const Estimate&, std::invoke_result_t<Position&, Vertex>,
                                                       std::invoke_result_t<Normal&, Vertex>>>;
    static_assert(Sink<std::remove_reference_t<S>, F>,
                  "nephroid::estimate_at: the sink takes (vertex index, estimate)");
    const std::size_t count = std::size_t(std::ranges::size(vertices));
    std::vector<F> estimates(count, flux_traits<F>::zero());
    detail::for_each_index(executor, count, 256, [&](std::size_t i) {
        auto&& vertex = detail::element_at(vertices, i);
        estimates[i] = estimate(std::invoke(position, vertex), std::invoke(normal, vertex));
    });
    for (std::size_t i = 0; i < count; ++i)
        sink(i, std::as_const(estimates[i]));
}

} // namespace nephroid
