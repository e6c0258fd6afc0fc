// SPDX-License-Identifier: MIT
/// @file  An estimate at every eye path vertex: the loop over the picture.
#pragma once

#include "nephroid/execution/executor.hpp"
#include "nephroid/receiver/sink.hpp"

#include <algorithm>
#include <functional>
#include <ranges>
#include <type_traits>
#include <utility>
#include <vector>

namespace nephroid {

/// Calls sink(vertex index, estimate(position, normal)) for every vertex of the user's array, serially and in its
/// order, when all have been estimated. For a fast look-up the order should be the picture's: neighbours follow each
/// other.
///
/// @param vertices  a random-access range
/// @param position  projection: a member pointer or a callable
/// @param normal    projection, unit
/// @param estimate  NearestPhotons, FixedRange, DifferentialMap, DiffusionEstimate, or any callable like them; called
///                  from several threads at once
/// @param executor  who runs the work; the result does not depend on it
/// @param sink      `Sink`
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
        auto&& vertex = std::ranges::begin(vertices)[std::ranges::range_difference_t<const Vertices>(i)];
        estimates[i] = estimate(std::invoke(position, vertex), std::invoke(normal, vertex));
    });
    for (std::size_t i = 0; i < count; ++i)
        sink(i, std::as_const(estimates[i]));
}

} // namespace nephroid
